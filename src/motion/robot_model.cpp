#include "outrider/motion/robot_model.hpp"

#include <cmath>

#include "outrider/core/units.hpp"

namespace outrider {

std::vector<Option> describe(RobotModel& robot) {
  return {
      {"radius", "m", 0.0, 100.0, "radius of the disk that the robot and what it carries sweep",
       &robot.radius_m},
      {"height", "m", 0.0, 100.0, "height of the robot; obstacles above it are driven under",
       &robot.height_m},
      {"speed", "m/s", 1e-3, 100.0, "driving speed limit", &robot.speed_mps},
      {"acceleration", "m/s2", 1e-3, 1e3, "driving acceleration limit", &robot.acceleration_mps2},
      {"turn_rate", "rad/s", 1e-3, 100.0, "turning speed limit", &robot.turn_rate_radps},
      {"turn_acceleration", "rad/s2", 1e-3, 1e4, "turning acceleration limit",
       &robot.turn_acceleration_radps2},
      {"max_slope", "deg", 0.0, 89.0, "steepest ground that it drives on, where there is terrain",
       &robot.max_slope_rad},
  };
}

DriveCost drive_cost(const RobotModel& robot, double heading_rad, const std::vector<Vec2>& waypoints,
                     const HeightField* terrain) {
  DriveCost cost;
  cost.heading_rad = heading_rad;
  for (std::size_t i = 1; i < waypoints.size(); ++i) {
    const Vec2 leg = waypoints[i] - waypoints[i - 1];
    if (norm(leg) == 0.0) continue;
    const double length = terrain != nullptr ? terrain->length({waypoints[i - 1], waypoints[i]}) : norm(leg);
    const double next = heading_of(leg);
    const double turn = std::abs(wrap_angle(next - cost.heading_rad));
    cost.time_s += duration(turn, robot.turning()) + duration(length, robot.straight());
    cost.driven_m += length;
    cost.turned_rad += turn;
    cost.heading_rad = next;
  }
  return cost;
}

}  // namespace outrider
