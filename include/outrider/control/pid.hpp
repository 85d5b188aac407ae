// PID control of a vector, with saturation, a floor and anti-windup.
//
//   command = p e + i integral(e) + d de/dt
//
// Its length is cut to `most`, so a saturated command keeps its direction. A command shorter than `least`,
// which would not move the motors, is made that long. The integral grows only while the command is not cut,
// or while growing makes it shorter (conditional integration: Astrom and Hagglund, Advanced PID Control,
// 2006, section 3.5), and is forgotten when the error turns against it: what was gathered on the way does not
// carry past the goal. A scalar is a vector with y = 0. O(1).
#pragma once

#include <optional>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/geometry/vec.hpp"

namespace outrider {

struct PidGains {
  double proportional = 0.4;  ///< 1/s
  double integral = 0.01;     ///< 1/s^2
  double derivative = 0.03;   ///< without a unit
};
std::vector<Option> describe(PidGains& gains);

/// Lengths of a command, in its unit.
struct PidRange {
  double most = 1.0;
  double least = 0.0;  ///< a command of no length stays 0
};

struct Pid {
  Vec2 integral;             ///< of the error, its unit times s
  std::optional<Vec2> last;  ///< the error before; none at first
};

/// The command for an error, `period_s` > 0 after the last one. The state moves on.
Vec2 step(Pid& pid, const PidGains& gains, Vec2 error, const PidRange& range, double period_s);

}  // namespace outrider
