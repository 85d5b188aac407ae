// Fits the pose of a robot on the floor to the corners of several tags at once.
#pragma once

#include <optional>
#include <vector>

#include "outrider/estimate/localise.hpp"

namespace outrider {

/// A tag and the image positions of its corners.
struct TagView {
  const Tag* tag = nullptr;
  std::array<Vec2, 4> corners_px;
};

/// Fits the six parameters of the pose of the robot with Levenberg-Marquardt, beginning at `start`. Minimises
/// the squared errors of the corners, weighted by image noise and tag placement, and of height, roll and
/// pitch. Returns x, y and heading, with a covariance that is scaled by the residuals as in planar_pnp.hpp.
/// If an `expected` pose is given, the covariance is the larger of those that are linearised at the answer
/// and at the expected pose: noise can push a tag that is seen from the front to an angle at which its
/// corners seem to tell the angle more precisely than they do. Returns nothing if a tag lies behind the
/// camera.
std::optional<PoseBelief> fit_on_floor(const Pose2& start, const std::vector<TagView>& views,
                                       const RobotCamera& robot_camera, const LocaliseOptions& options,
                                       const std::optional<Pose2>& expected = std::nullopt);

}  // namespace outrider
