// WheelFaults and LinkFaults: models of imperfect wheels and of a lossy, delayed command link.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/motion/chassis.hpp"

namespace outrider {

/// Faults of wheels. In steady state: speed = gain of the wheel * gain of its direction of rotation * sag *
/// (1 + noise) * commanded speed.
struct WheelFaults {
  WheelSpeeds4 gains = {1.0, 1.0, 1.0, 1.0};  ///< gain of each wheel
  double backwards = 1.0;                     ///< additional gain of a wheel that turns backwards
  double dead_time_s = 0.0;                   ///< delay from a command to the first motion of a wheel at rest
  double lag_s = 0.0;                         ///< time constant with which speeds follow commands
  double deadband_radps = 0.0;                ///< commands below it leave the wheel at rest
  double sag_per_min = 0.0;                   ///< fraction of the speed lost per minute of driving
  double strafe_slip = 0.0;                   ///< fraction of sideways motion lost
  double noise = 0.0;                         ///< standard deviation of the relative noise of each wheel
  double noise_time_s = 0.2;                  ///< correlation time of the noise
  std::int64_t stuck_wheel = 1;               ///< number of the wheel that sticks, from 1
  double stuck_from_s = 1e9;                  ///< from then on it does not turn
  double stuck_for_s = 1e9;                   ///< for how long

  [[nodiscard]] bool stuck(std::size_t wheel, double time_s) const {
    return wheel + 1 == static_cast<std::size_t>(stuck_wheel) && time_s >= stuck_from_s &&
           time_s < stuck_from_s + stuck_for_s;
  }
};
std::vector<Option> describe(WheelFaults& faults);

/// Loss and delay of messages. They keep their order but for those that are repeated or reordered.
struct LinkFaults {
  std::int64_t lost = 0;     ///< messages that are lost at the beginning
  double delay_s = 0.0;      ///< constant delay
  double jitter_s = 0.0;     ///< added to the delay, uniform from 0
  double down_from_s = 1e9;  ///< from then on what is sent is lost
  double down_for_s = 1e9;   ///< for how long
  double repeated = 0.0;     ///< fraction of the messages that arrive a second time
  double reordered = 0.0;    ///< fraction of the messages that are overtaken by others
  double later_s = 0.5;      ///< by how much these come later, uniform from 0

  [[nodiscard]] bool down(double time_s) const {
    return time_s >= down_from_s && time_s < down_from_s + down_for_s;
  }
};
std::vector<Option> describe(LinkFaults& faults);

}  // namespace outrider
