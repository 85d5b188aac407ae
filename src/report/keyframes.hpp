// A run squeezed into a short loop: which instants to keep, and which to slow down.
#pragma once

#include <cstddef>
#include <vector>

#include "outrider/geometry/vec.hpp"
#include "outrider/report/page_report.hpp"

namespace outrider {

/// A quantity at an instant. Angles use x alone.
struct Key {
  double time = 0.0;
  Vec2 value;
};

/// The fewest keys that Douglas and Peucker's rule keeps, so that linear interpolation in time
/// between them is within `tolerance` of every key given. First and last stay. Typically O(n log n).
/// Source: Douglas and Peucker, Cartographica 10 (1973) 112-122, with the distance taken at equal time.
std::vector<Key> simplified(const std::vector<Key>& keys, double tolerance);

/// The track at a time, linear between samples; headings and yaws turn the shorter way. The ends hold.
/// The track is not empty and its times do not decrease. O(log n).
TrackSample sample_at(const std::vector<TrackSample>& track, double time_s);

/// Maps times of the run to times of the loop, monotone and piecewise linear.
///
/// A ball flies for a second of a run of many minutes, and could not be seen: flights are shown for
/// at least 0.4 s each, as long as all flights together take at most 45 % of the loop. The last 6 % of
/// the loop show the end.
class LoopClock {
 public:
  LoopClock(const PageReport& report, double loop_s);

  [[nodiscard]] double loop_s() const { return loop_s_; }
  [[nodiscard]] double end_s() const { return knots_.back().run_s; }
  [[nodiscard]] double to_loop(double run_s) const;
  [[nodiscard]] double to_run(double loop_s) const;
  /// The times of the run at which its speed in the loop changes.
  [[nodiscard]] std::vector<double> changes() const;

 private:
  struct Knot {
    double run_s = 0.0;
    double loop_s = 0.0;
  };
  double loop_s_;
  std::vector<Knot> knots_;
};

}  // namespace outrider
