// Planar PnP: the pose of a tag from its four corners, with both of its solutions.
//
// A square seen from far is almost as well explained by a second pose, tilted the other way. Both come back:
// IPPE gives two candidates in closed form, Gauss-Newton on the reprojection error takes each to its local
// minimum, and where both end in the same one, one is left. Who chooses needs more than one tag: see
// localise.hpp.
//
// Covariance: (J^T J)^-1 sigma^2 at the minimum. sigma^2 is estimated from the reprojection error, of which
// four corners leave but two degrees of freedom; `corner_sigma_px` says what is expected and weighs as much
// as `corner_sigma_weight` more degrees (the mean of a scaled inverse chi-squared distribution).
//
// Source: Collins and Bartoli, Infinitesimal plane-based pose estimation (IJCV 2014).
#pragma once

#include <array>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/estimate/camera.hpp"
#include "outrider/estimate/tag.hpp"

namespace outrider {

struct PlanarPnpOptions {
  double corner_sigma_px = 0.2;       ///< expected error of a corner along each axis, > 0
  double corner_sigma_weight = 10.0;  ///< degrees of freedom that the expectation is worth
};

std::vector<Option> describe(PlanarPnpOptions& options);

/// The local minima found, one or two, the least error first; none when the corners are no convex
/// quadrilateral, or no pose puts the tag in front of the camera. O(1).
std::vector<TagPose> planar_pnp(const Camera& camera, double size_m, const std::array<Vec2, 4>& corners_px,
                                const PlanarPnpOptions& options = {});

}  // namespace outrider
