// Pace: the ranges of the speed and the turn rate of a robot.
#pragma once

#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/motion/profile.hpp"

namespace outrider {

/// Ranges of speeds: the true speed is between the slowest and the full speed.
struct Pace {
  double speed_mps = 0.15;
  double slowest_speed_mps = 0.09;
  double acceleration_mps2 = 0.5;
  double turn_rate_radps = 2.449;
  double slowest_turn_rate_radps = 0.7347;
  double turn_acceleration_radps2 = 10.0;
  double pause_s = 1.0;  ///< time for which the robot stands before it turns in place

  [[nodiscard]] Limits straight() const { return {speed_mps, acceleration_mps2}; }
  [[nodiscard]] Limits turning() const { return {turn_rate_radps, turn_acceleration_radps2}; }
  /// Returns the pace with the slowest speeds as full speeds.
  [[nodiscard]] Pace slow() const;
};
std::vector<Option> describe(Pace& pace);
/// Checks that the slowest speed and turn rate are not above the full ones.
Status check(const Pace& pace);

}  // namespace outrider
