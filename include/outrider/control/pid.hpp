// PID control of a vector, with saturation, a floor and anti-windup.
//
//   command = p e + i integral(e) + d de/dt
//
// A command longer than `most` is shortened to it and keeps its direction. A command shorter than `least`,
// which would not move the motors, is lengthened to it. Anti-windup: the integral grows only while the
// command is not saturated, or if growing makes it shorter (conditional integration: Astrom and Hagglund,
// Advanced PID Control, 2006, section 3.5). It is reset when the error points against it, so the robot does
// not overshoot by what was integrated on the way. A scalar is a vector with y = 0. O(1).
#pragma once

#include <optional>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/geometry/vec.hpp"

namespace outrider {

/// Gains of a controller.
struct PidGains {
  double proportional = 0.4;  ///< 1/s
  double integral = 0.01;     ///< 1/s^2
  double derivative = 0.03;   ///< without unit
};
std::vector<Option> describe(PidGains& gains);

/// Limits of the length of a command, in its unit.
struct PidRange {
  double most = 1.0;   ///< longest command
  double least = 0.0;  ///< shortest command that is not zero; a zero command stays zero
};

/// The state of a controller.
struct Pid {
  Vec2 integral;             ///< integral of the error over time
  std::optional<Vec2> last;  ///< the last error; none before the first step
};

/// Computes the command for an error measured `period_s` > 0 after the last one, and updates the state.
Vec2 step(Pid& pid, const PidGains& gains, Vec2 error, const PidRange& range, double period_s);

}  // namespace outrider
