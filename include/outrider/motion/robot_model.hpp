// RobotModel: a disk robot that turns in place, then drives straight.
#pragma once

#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/core/units.hpp"
#include "outrider/geometry/pose.hpp"
#include "outrider/motion/profile.hpp"
#include "outrider/world/height_field.hpp"

namespace outrider {

struct RobotModel {
  double radius_m = 0.26;  ///< of the disk that everything the robot carries stays within
  double height_m = 0.2;   ///< obstacles above it are driven under
  double speed_mps = 0.8;
  double acceleration_mps2 = 0.8;
  double turn_rate_radps = 0.8;
  double turn_acceleration_radps2 = 6.0;
  double max_slope_rad = radians(20.0);  ///< it neither drives nor stands on ground that is steeper

  [[nodiscard]] Limits straight() const { return {speed_mps, acceleration_mps2}; }
  [[nodiscard]] Limits turning() const { return {turn_rate_radps, turn_acceleration_radps2}; }
};

std::vector<Option> describe(RobotModel& robot);

/// Time, distance and turns of following waypoints, with a turn in place before each straight. On terrain the
/// length of a straight is measured on the surface, headings and turns in the horizontal plane.
struct DriveCost {
  double time_s = 0.0;
  double driven_m = 0.0;
  double turned_rad = 0.0;
  double heading_rad = 0.0;  ///< at the end
};
DriveCost drive_cost(const RobotModel& robot, double heading_rad, const std::vector<Vec2>& waypoints,
                     const HeightField* terrain = nullptr);

}  // namespace outrider
