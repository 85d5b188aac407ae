// Calibration: how a robot responds to commands, and the commands that compensate for it.
//
// A steady command in one of six directions brings the body
//   distance = a t + b   and   angle = a t + b,   a = gain * commanded speed,   b = -a * dead time,
// for a robot that starts and ends at rest; and each wheel has a gain of its own, relative to their mean.
// The default is an ideal robot.
#pragma once

#include <array>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/motion/chassis.hpp"

namespace outrider {

/// The directions of a body, in the order of DirectionLaws.
enum class Direction { ahead, back, left, right, counter_clockwise, clockwise };
inline constexpr std::size_t directions = 6;
/// "ahead", "back", ...
std::string_view to_string(Direction direction);

struct DirectionLaw {
  double gain = 1.0;         ///< speed by commanded speed
  double dead_time_s = 0.0;  ///< part of the time of a command in which it does not move
};

struct Calibration {
  WheelSpeeds4 wheels = {1.0, 1.0, 1.0, 1.0};  ///< gain of each wheel, relative to their mean
  std::array<DirectionLaw, directions> laws;   ///< by direction
};

/// Two groups, wheels and laws: the keys of a calibration file.
std::vector<OptionGroup> describe(Calibration& calibration);

/// The gain and dead time that go with the sign of each part of a twist.
const DirectionLaw& ahead_law(const Calibration& calibration, double ahead_mps);
const DirectionLaw& left_law(const Calibration& calibration, double left_mps);
const DirectionLaw& turn_law(const Calibration& calibration, double turn_radps);

/// The wheel speeds to command so that the body moves with that twist once it moves.
WheelSpeeds4 commanded_wheels(const Chassis& chassis, const Calibration& calibration, const Twist2& wanted);

}  // namespace outrider
