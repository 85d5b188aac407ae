// PoseBelief: an estimated pose of a robot on a floor, with its covariance.
#pragma once

#include <Eigen/Core>

#include "outrider/geometry/pose.hpp"

namespace outrider {

/// A normal distribution of world_T_robot: x (m), y (m) and heading (rad), with errors along the world axes.
struct PoseBelief {
  Pose2 world_T_robot;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

}  // namespace outrider
