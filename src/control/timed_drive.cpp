#include "outrider/control/timed_drive.hpp"

#include <algorithm>
#include <cmath>

#include "outrider/core/units.hpp"

namespace outrider {
namespace {

constexpr double least_turn_rad = 1e-6;
constexpr double least_way_m = 1e-6;

/// Solves distance = a t + b for t; the twist is the calibrated one, so a is its speed.
double time_for(double distance, double speed, const DirectionLaw& law) {
  return std::max(0.0, distance / speed + law.dead_time_s);
}

TimedMotion turn(double angle_rad, const TimedDriveOptions& options, const Calibration& calibration) {
  if (std::abs(angle_rad) < least_turn_rad) return {};
  const double rate = std::copysign(options.turn_rate_radps, angle_rad);
  return {{0.0, 0.0, rate},
          time_for(std::abs(angle_rad), options.turn_rate_radps, turn_law(calibration, rate)),
          options.rest_s};
}

TimedMotion straight(double way_m, const TimedDriveOptions& options, const Calibration& calibration) {
  if (way_m < least_way_m) return {};
  return {{options.speed_mps, 0.0, 0.0},
          time_for(way_m, options.speed_mps, ahead_law(calibration, options.speed_mps)),
          options.rest_s};
}

}  // namespace

std::vector<TimedMotion> timed_drive(const Pose2& start, const std::vector<Pose2>& waypoints,
                                     const TimedDriveOptions& options, const Calibration& calibration) {
  std::vector<TimedMotion> motions;
  Pose2 at = start;
  for (const Pose2& goal : waypoints) {
    const Vec2 way = goal.position - at.position;
    const double bearing = norm(way) < least_way_m ? at.heading_rad : heading_of(way);
    motions.push_back(turn(wrap_angle(bearing - at.heading_rad), options, calibration));
    motions.push_back(straight(norm(way), options, calibration));
    motions.push_back(turn(wrap_angle(goal.heading_rad - bearing), options, calibration));
    motions.back().at_waypoint = true;
    at = goal;
  }
  return motions;
}

}  // namespace outrider
