// Calibration: the response of a robot to commands, and the commands that compensate for it.
//
// A steady command in one of six directions moves the body, from rest to rest, by
//   distance = a t + b   or   angle = a t + b,   with a = gain * commanded speed and b = -a * dead time.
// In addition, each wheel has its own gain relative to the mean of the wheels. The default is an ideal robot.
#pragma once

#include <array>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/motion/chassis.hpp"

namespace outrider {

/// The directions of a body, in the order of DirectionLaws.
enum class Direction { ahead, back, left, right, counter_clockwise, clockwise };
inline constexpr std::size_t directions = 6;
/// Returns the name of a direction: "ahead", "back", ...
std::string_view to_string(Direction direction);

/// The response in one direction.
struct DirectionLaw {
  double gain = 1.0;         ///< speed divided by commanded speed
  double dead_time_s = 0.0;  ///< time of a command during which the robot does not move
};

/// The calibration of a robot.
struct Calibration {
  WheelSpeeds4 wheels = {1.0, 1.0, 1.0, 1.0};  ///< gain of each wheel, relative to their mean
  std::array<DirectionLaw, directions> laws;   ///< by direction
};

/// Returns two groups, wheels and laws: the keys of a calibration file.
std::vector<OptionGroup> describe(Calibration& calibration);

/// Return the law for the sign of each component of a twist.
const DirectionLaw& ahead_law(const Calibration& calibration, double ahead_mps);
const DirectionLaw& left_law(const Calibration& calibration, double left_mps);
const DirectionLaw& turn_law(const Calibration& calibration, double turn_radps);

/// Returns the wheel speeds to command so that the body moves with the twist `wanted` once it moves.
WheelSpeeds4 commanded_wheels(const Chassis& chassis, const Calibration& calibration, const Twist2& wanted);

}  // namespace outrider
