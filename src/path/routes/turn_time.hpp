// The time of turns in place, for many turns with the same limits.
#pragma once

#include <algorithm>
#include <cmath>

#include "outrider/core/units.hpp"
#include "outrider/motion/drive.hpp"

namespace outrider::routes {

/// Computes duration() of a turn between two headings, with its constant part precomputed.
class TurnTime {
 public:
  explicit TurnTime(const Limits& limits)
      : limits_(limits),
        ramp_s_(limits.speed / limits.acceleration),
        full_speed_rad_(limits.speed * ramp_s_),
        half_turn_s_((*this)(0.0, pi)) {}

  /// Both headings lie in (-pi, pi].
  double operator()(double from_rad, double to_rad) const {
    const double apart = std::abs(from_rad - to_rad);
    const double angle = std::min(apart, 2.0 * pi - apart);
    return angle > full_speed_rad_ ? angle / limits_.speed + ramp_s_ : duration(angle, limits_);
  }

  /// Returns the time of the longest turn.
  [[nodiscard]] double half_turn_s() const { return half_turn_s_; }

 private:
  Limits limits_;
  double ramp_s_;
  double full_speed_rad_;
  double half_turn_s_;
};

}  // namespace outrider::routes
