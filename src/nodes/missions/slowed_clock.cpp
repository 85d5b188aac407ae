#include "outrider/nodes/missions/slowed_clock.hpp"

#include <algorithm>

namespace outrider {
namespace {

constexpr double moments_kept_s = 10.0;

}  // namespace

void SlowedClock::begin(double now_s) {
  kept_ = {{now_s, 0.0}};
  rate_ = 1.0;
}

void SlowedClock::advance(double now_s, double rate_per_s) {
  const double passed_s = std::max(0.0, now_s - kept_.back().now_s);
  kept_.push_back({now_s, kept_.back().time_s + rate_ * passed_s});
  while (kept_.size() > 2 && kept_.front().now_s < now_s - moments_kept_s) kept_.pop_front();
  rate_ = std::clamp(rate_ + rate_per_s * passed_s, 0.0, 1.0);
}

double SlowedClock::time_at(double then_s) const {
  const auto after = std::ranges::upper_bound(kept_, then_s, {}, &Moment::now_s);
  if (after == kept_.end()) return kept_.back().time_s;
  if (after == kept_.begin()) return after->time_s - (after->now_s - then_s);
  const Moment& before = *std::prev(after);
  return before.time_s +
         (then_s - before.now_s) / (after->now_s - before.now_s) * (after->time_s - before.time_s);
}

}  // namespace outrider
