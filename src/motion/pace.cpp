#include "outrider/motion/pace.hpp"

#include <fmt/format.h>

namespace outrider {

Pace Pace::slow() const {
  Pace slow = *this;
  slow.speed_mps = slowest_speed_mps;
  slow.turn_rate_radps = slowest_turn_rate_radps;
  return slow;
}

std::vector<Option> describe(Pace& pace) {
  return {
      {"speed", "m/s", 1e-3, 100.0, "driving speed", &pace.speed_mps},
      {"slowest_speed", "m/s", 1e-3, 100.0, "driving speed that the robot never falls below on the way",
       &pace.slowest_speed_mps},
      {"acceleration", "m/s2", 1e-3, 1e3, "driving acceleration", &pace.acceleration_mps2},
      {"turn_rate", "rad/s", 1e-3, 100.0, "turning speed", &pace.turn_rate_radps},
      {"slowest_turn_rate", "rad/s", 1e-3, 100.0, "turning speed that the robot never falls below",
       &pace.slowest_turn_rate_radps},
      {"turn_acceleration", "rad/s2", 1e-3, 1e4, "turning acceleration", &pace.turn_acceleration_radps2},
      {"pause", "s", 0.0, 1e3, "how long the robot stands where it turns in place", &pace.pause_s},
  };
}

Status check(const Pace& pace) {
  if (pace.slowest_speed_mps > pace.speed_mps) {
    return bad_input(fmt::format("{:g} m/s is above the speed of {:g} m/s; give at most that",
                                 pace.slowest_speed_mps, pace.speed_mps),
                     "pace.slowest_speed");
  }
  if (pace.slowest_turn_rate_radps > pace.turn_rate_radps) {
    return bad_input(fmt::format("{:g} rad/s is above the turn rate of {:g} rad/s; give at most that",
                                 pace.slowest_turn_rate_radps, pace.turn_rate_radps),
                     "pace.slowest_turn_rate");
  }
  return {};
}

}  // namespace outrider
