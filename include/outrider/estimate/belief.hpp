// PoseBelief: where a robot on a floor is, and how sure that is.
#pragma once

#include <array>

#include "outrider/geometry/pose.hpp"

namespace outrider {

using Covariance3 = std::array<std::array<double, 3>, 3>;
using Covariance6 = std::array<std::array<double, 6>, 6>;

/// A normal distribution of world_T_robot: x (m), y (m) and heading (rad), errors along the world's axes.
struct PoseBelief {
  Pose2 world_T_robot;
  Covariance3 covariance{};
};

}  // namespace outrider
