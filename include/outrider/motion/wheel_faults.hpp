// WheelFaults and LinkFaults: models of imperfect wheels and of a lossy, delayed command link.
#pragma once

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
};
std::vector<Option> describe(WheelFaults& faults);

/// Loss and delay of commands. Commands keep their order.
struct LinkFaults {
  std::int64_t lost = 0;  ///< messages that are lost at the beginning
  double delay_s = 0.0;   ///< constant delay
  double jitter_s = 0.0;  ///< added to the delay, uniform from 0
};
std::vector<Option> describe(LinkFaults& faults);

}  // namespace outrider
