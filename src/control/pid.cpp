#include "outrider/control/pid.hpp"

namespace outrider {

std::vector<Option> describe(PidGains& gains) {
  return {
      {"p", "1/s", 0.0, 100.0, "command per error", &gains.proportional},
      {"i", "1/s2", 0.0, 100.0, "command per error and second that it lasts", &gains.integral},
      {"d", "", 0.0, 100.0, "command per speed of the error", &gains.derivative},
  };
}

Vec2 step(Pid& pid, const PidGains& gains, Vec2 error, const PidRange& range, double period_s) {
  if (dot(pid.integral, error) < 0.0) pid.integral = {};
  const Vec2 change = pid.last ? (1.0 / period_s) * (error - *pid.last) : Vec2{};
  pid.last = error;
  const Vec2 rest = gains.proportional * error + gains.derivative * change;
  const Vec2 before = rest + gains.integral * pid.integral;
  const Vec2 grown = pid.integral + period_s * error;
  const Vec2 after = rest + gains.integral * grown;
  if (norm(after) <= range.most || norm(after) < norm(before)) pid.integral = grown;
  const Vec2 command = rest + gains.integral * pid.integral;
  const double length = norm(command);
  if (length == 0.0) return {};
  if (length > range.most) return (range.most / length) * command;
  if (length < range.least) return (range.least / length) * command;
  return command;
}

}  // namespace outrider
