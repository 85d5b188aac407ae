#include "outrider/motion/straights.hpp"

#include <cmath>

#include "outrider/motion/profile.hpp"

namespace outrider {

std::vector<Straight> straights(const RobotModel& robot, double heading_rad,
                                const std::vector<Vec2>& waypoints, const HeightField* terrain) {
  std::vector<Straight> result;
  double time = 0.0;
  for (std::size_t i = 1; i < waypoints.size(); ++i) {
    const Vec2 leg = waypoints[i] - waypoints[i - 1];
    if (norm(leg) == 0.0) continue;
    time += duration(std::abs(wrap_angle(heading_of(leg) - heading_rad)), robot.turning());
    heading_rad = heading_of(leg);
    const double length_m =
        terrain != nullptr ? terrain->length({waypoints[i - 1], waypoints[i]}) : norm(leg);
    const double length_s = duration(length_m, robot.straight());
    result.push_back({i, waypoints[i - 1], waypoints[i], time, length_s});
    time += length_s;
  }
  return result;
}

}  // namespace outrider
