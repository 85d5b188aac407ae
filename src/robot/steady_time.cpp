#include "outrider/robot/steady_time.hpp"

#include <algorithm>
#include <cmath>

namespace outrider {
namespace {

constexpr double late_s = 2.0;

/// Rounds to nanoseconds, so that times are the same with and without a shift.
double rounded(double time_s) { return std::abs(time_s) < 1e6 ? std::round(1e9 * time_s) / 1e9 : time_s; }

}  // namespace

double SteadyTime::note(double clock_s) {
  const double as_before_s = clock_s + shift_s_;
  const bool back = clock_s_ && clock_s < *clock_s_;
  if (back || (expected_s_ && as_before_s > *expected_s_ + late_s)) {
    shift_before_s_ = shift_s_;
    shift_s_ = std::max(now_s_, expected_s_.value_or(now_s_)) - clock_s;
    ++jumps_;
  }
  clock_s_ = clock_s;
  now_s_ = rounded(clock_s + shift_s_);
  return now_s_;
}

/// Returns the steady time of a measurement made before or after the last jump: of the two that which is past
/// and nearer to the present.
double SteadyTime::of(double clock_s) const {
  const double now = rounded(clock_s + shift_s_), before = rounded(clock_s + shift_before_s_);
  if (jumps_ == 0 || before > now_s_) return now;
  if (now > now_s_) return before;
  return std::max(now, before);
}

Observation SteadyTime::steady(Observation seen) {
  seen.time_s = note(seen.time_s);
  expected_s_.reset();
  if (seen.scan) seen.scan->time_s = of(seen.scan->time_s);
  if (seen.image) seen.image->taken_s = of(seen.image->taken_s);
  return seen;
}

Command SteadyTime::on_clock(Command command) {
  const auto shift = [this](double& until_s) {
    expected_s_ = until_s;
    until_s -= shift_s_;
  };
  if (auto* twist = std::get_if<DriveTwist>(&command)) shift(twist->until_s);
  if (auto* wheels = std::get_if<DriveWheels>(&command)) shift(wheels->until_s);
  return command;
}

}  // namespace outrider
