// Planar PnP: the pose of a tag from its four corners, with both of its solutions.
//
// A second pose, tilted the other way, explains a distant square almost as well. Both are returned: IPPE
// gives two candidates in closed form, and Levenberg-Marquardt takes each to a local minimum of the
// reprojection error. If both reach the same minimum, it is returned once. Choosing between them takes more
// than one tag: see localise.hpp.
//
// Covariance: (J^T J)^-1 sigma^2 at the minimum. sigma^2 is estimated from the reprojection error, which has
// only two degrees of freedom with four corners. The prior `corner_sigma_px` counts as `corner_sigma_weight`
// more degrees of freedom (the mean of a scaled inverse chi-squared distribution).
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
  double corner_sigma_weight = 10.0;  ///< degrees of freedom of that prior
};

std::vector<Option> describe(PlanarPnpOptions& options);

/// Returns the one or two local minima, least error first; none if the corners are no convex quadrilateral,
/// or no pose has the tag in front of the camera. O(1).
std::vector<TagPose> planar_pnp(const Camera& camera, double size_m, const std::array<Vec2, 4>& corners_px,
                                const PlanarPnpOptions& options = {});

}  // namespace outrider
