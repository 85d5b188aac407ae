// The pose of a robot on the floor that fits the corners of several tags at once.
#pragma once

#include <optional>
#include <vector>

#include "outrider/estimate/localise.hpp"

namespace outrider {

/// A tag and where its corners appear.
struct TagView {
  const Tag* tag = nullptr;
  std::array<Vec2, 4> corners_px;
};

/// Gauss and Newton from `start` to the least sum of squares of the corners, each by its covariance (error in
/// the image and of where the tag hangs), and of the height, roll and pitch of the robot. Over all six
/// numbers of its pose; x, y and heading are told. The covariance is scaled by how well all fits, which
/// weighs against the expectation as in planar_pnp.hpp. Nothing when a tag comes to lie behind the camera.
std::optional<PoseBelief> fit_on_floor(const Pose2& start, const std::vector<TagView>& views,
                                       const RobotCamera& robot_camera, const LocaliseOptions& options);

}  // namespace outrider
