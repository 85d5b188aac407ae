// SlowedClock: the time of a mission whose robot drives more slowly than planned.
//
// Commands that are followed at a part of their speed, for as much longer, lead along the same way. So a
// mission can be stopped and go on: its time passes at the rate at which its robot drives.
#pragma once

#include <deque>

namespace outrider {

class SlowedClock {
 public:
  /// Begins with time 0 and rate 1.
  void begin(double now_s);
  /// Lets time pass at the present rate, then changes the rate by so much a second, within 0 and 1.
  void advance(double now_s, double rate_per_s);

  [[nodiscard]] double rate() const { return rate_; }
  /// Returns the time of the mission now, or at an earlier time of the last 10 s. Times before are negative
  /// or too late by what was waited before.
  [[nodiscard]] double time_s() const { return kept_.back().time_s; }
  [[nodiscard]] double time_at(double then_s) const;

 private:
  struct Moment {
    double now_s = 0.0;
    double time_s = 0.0;
  };
  std::deque<Moment> kept_{{}};
  double rate_ = 1.0;
};

}  // namespace outrider
