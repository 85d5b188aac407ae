// The common parts of spoiling laser logs and landmark logs.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "faults/spoil.hpp"
#include "outrider/geometry/pose.hpp"

namespace outrider {

inline Pose2 scaled(const Pose2& motion, double ratio) {
  return {ratio * motion.position, ratio * motion.heading_rad};
}

/// Returns what odometry counts of a motion.
inline Pose2 counted(const Pose2& motion, const RecordingFaults& faults, double time_s) {
  if (faults.stuck(time_s)) return {};
  if (faults.slip == 0.0) return motion;
  return scaled(motion, 1.0 / (1.0 - faults.slip));
}

/// Returns what a range becomes with its scale and the bias, which leaves some of it.
inline double biased(double range_m, const RecordingFaults& faults) {
  constexpr double least_m = 0.01;
  range_m *= faults.range_scale;
  return faults.bias_m == 0.0 ? range_m : std::max(least_m, range_m + faults.bias_m);
}

/// Cuts out the steps of the part that is missing, and sets the clock of the later ones back, so that no
/// pause tells of it. `times_s` are the times of the steps in the run, and `clock(step)` is the recorded one.
/// Returns the number of steps cut out between others; where the recording only ends sooner, that is 0.
template <class Step, class Clock>
std::size_t cut_out(std::vector<Step>& steps, const std::vector<double>& times_s,
                    const RecordingFaults& faults, const Clock& clock) {
  const auto is_cut = [&](double time_s) { return faults.cut(time_s); };
  const auto first = std::ranges::find_if(times_s, is_cut);
  const auto last = std::find_if_not(first, times_s.end(), is_cut);
  const auto cut_begin = steps.begin() + (first - times_s.begin());
  const auto cut_end = steps.begin() + (last - times_s.begin());
  const auto count = static_cast<std::size_t>(last - first);
  const bool is_between = cut_begin != steps.begin() && cut_end != steps.end();
  if (is_between && count > 0) {
    const double shift_s = clock(*cut_end) - clock(*cut_begin);
    std::for_each(cut_end, steps.end(), [&](Step& later) { clock(later) -= shift_s; });
  }
  steps.erase(cut_begin, cut_end);
  return is_between ? count : 0;
}

inline tl::unexpected<Fault> nothing_left() {
  return bad_input("nothing is left of the recording; give faults that leave a part of it", "faults");
}

}  // namespace outrider
