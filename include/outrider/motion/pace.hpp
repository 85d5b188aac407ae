// Pace: the spans of speeds at which a robot drives and turns.
#pragma once

#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/motion/profile.hpp"

namespace outrider {

/// Speeds are known as spans: the robot goes at least as fast as the slow one and at most as the other.
struct Pace {
  double speed_mps = 0.15;
  double slowest_speed_mps = 0.09;
  double acceleration_mps2 = 0.5;
  double turn_rate_radps = 2.449;
  double slowest_turn_rate_radps = 0.7347;
  double turn_acceleration_radps2 = 10.0;
  double pause_s = 1.0;  ///< the robot stands so long where it turns in place

  [[nodiscard]] Limits straight() const { return {speed_mps, acceleration_mps2}; }
  [[nodiscard]] Limits turning() const { return {turn_rate_radps, turn_acceleration_radps2}; }
  /// The same robot at its slowest.
  [[nodiscard]] Pace slow() const;
};
std::vector<Option> describe(Pace& pace);
/// Refuses a slowest speed or turn rate above the fastest.
Status check(const Pace& pace);

}  // namespace outrider
