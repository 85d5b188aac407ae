// RobotModel: a disk robot that turns in place, or steers like a car.
#pragma once

#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/core/units.hpp"
#include "outrider/geometry/pose.hpp"
#include "outrider/motion/profile.hpp"
#include "outrider/world/height_field.hpp"

namespace outrider {

/// Size and motion limits of a robot.
struct RobotModel {
  double radius_m = 0.26;                 ///< radius of a disk that contains the robot and all it carries
  double height_m = 0.2;                  ///< height; the robot drives under obstacles above it
  double speed_mps = 0.8;                 ///< maximum speed
  double acceleration_mps2 = 0.8;         ///< maximum acceleration and deceleration
  double turn_rate_radps = 0.8;           ///< maximum turn rate
  double turn_acceleration_radps2 = 6.0;  ///< maximum angular acceleration
  double max_slope_rad = radians(20.0);   ///< steepest ground on which it drives or stands
  double turning_radius_m = 0.0;          ///< least radius of a curve, as of a car; 0: it turns in place

  [[nodiscard]] Limits straight() const { return {speed_mps, acceleration_mps2}; }
  [[nodiscard]] Limits turning() const { return {turn_rate_radps, turn_acceleration_radps2}; }
  /// Returns true if it drives curves only.
  [[nodiscard]] bool steers() const { return turning_radius_m > 0.0; }
};

std::vector<Option> describe(RobotModel& robot);

/// The cost of a drive along waypoints, with a turn in place before each straight leg. On terrain, lengths
/// are measured on the surface, and headings and turns in the horizontal plane.
struct DriveCost {
  double time_s = 0.0;
  double driven_m = 0.0;
  double turned_rad = 0.0;
  double heading_rad = 0.0;  ///< heading at the end
};
/// Returns the cost of a drive that begins with that heading. `terrain` is null on flat ground.
DriveCost drive_cost(const RobotModel& robot, double heading_rad, const std::vector<Vec2>& waypoints,
                     const HeightField* terrain = nullptr);

}  // namespace outrider
