// RecordingClock: how long a recording took, if its times can be believed.
//
// The clock of a log may stand (times rounded to six digits), go back (a counter that wraps), or jump (it was
// set while the robot drove). Thread rule: one at a time.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

namespace outrider {

class RecordingClock {
 public:
  /// Notes the time of the next scan.
  void note(double time_s) {
    if (count_++ == 0) first_s_ = last_s_ = time_s;
    const double step_s = time_s - last_s_;
    is_finite_ = is_finite_ && std::isfinite(time_s);
    going_on_ += step_s > 0.0 ? 1 : 0;
    back_s_ = std::max(back_s_, -step_s);
    longest_s_ = std::max(longest_s_, step_s);
    last_s_ = time_s;
  }

  /// Returns the time from the first scan to the last. Returns nothing if the times increase in fewer than
  /// nine of ten steps, if the clock goes back by more than a second, or if one step of ten or more makes up
  /// more than half of the time.
  [[nodiscard]] std::optional<double> length_s() const {
    constexpr double least_going_on = 0.9, most_back_s = 1.0, most_of_it = 0.5;
    constexpr std::size_t few = 10;
    const double length_s = last_s_ - first_s_;
    if (count_ < 2 || !is_finite_ || !(length_s > 0.0) || back_s_ > most_back_s) return std::nullopt;
    if (static_cast<double>(going_on_) < least_going_on * static_cast<double>(count_ - 1))
      return std::nullopt;
    if (count_ > few && longest_s_ > most_of_it * length_s) return std::nullopt;
    return length_s;
  }

 private:
  std::size_t count_ = 0;
  std::size_t going_on_ = 0;  ///< steps in which the time increases
  bool is_finite_ = true;
  double first_s_ = 0.0;
  double last_s_ = 0.0;
  double back_s_ = 0.0;     ///< by which it goes back at most
  double longest_s_ = 0.0;  ///< step
};

}  // namespace outrider
