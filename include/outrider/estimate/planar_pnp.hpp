// Planar PnP: computes the pose of a tag from its four corners, with both solutions.
//
// A second pose, tilted the other way, explains a distant square almost as well, so both are returned. IPPE
// gives two candidates in closed form, and Levenberg-Marquardt refines each to a local minimum of the
// reprojection error. If both reach the same minimum, it is returned once. More than one tag is needed to
// choose between the two: see localise.hpp.
//
// The covariance is (J^T J)^-1 sigma^2 at the minimum. sigma^2 is estimated from the reprojection error,
// which has only two degrees of freedom with four corners. The prior `corner_sigma_px` counts as
// `corner_sigma_weight` more degrees of freedom (the mean of a scaled inverse chi-squared distribution).
//
// The probability of a solution weighs the two: the likelihood of the corners, integrated around its minimum
// and over the variance of a corner. It is right as far as corners err as the prior says and all poses that
// show the tag are equally likely.
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

/// Returns the one or two local minima, the smallest error first. Returns none if the corners are not a
/// convex quadrilateral seen from the front, or if no pose has the tag in front of the camera. O(1).
std::vector<TagPose> planar_pnp(const Camera& camera, double size_m, const std::array<Vec2, 4>& corners_px,
                                const PlanarPnpOptions& options = {});

}  // namespace outrider
