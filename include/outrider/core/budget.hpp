// Budget: how much work a planner may do before it must answer. One argument of every planner.
//
// Expansions come first because they repeat exactly; wall time is a second limit for people who
// wait, and is unlimited by default so that it never changes a result unasked.
#pragma once

#include <chrono>
#include <cstdint>
#include <limits>
#include <optional>
#include <stop_token>

#include "outrider/core/outcome.hpp"

namespace outrider {

struct Budget {
  std::uint64_t expansions = std::numeric_limits<std::uint64_t>::max();
  std::optional<std::chrono::nanoseconds> wall_time;
  std::stop_token stop;
};

/// Counts expansions against a budget. The token is read at every expansion, as some take a millisecond; the
/// clock every 1024.
class BudgetMeter {
 public:
  explicit BudgetMeter(const Budget& budget);

  /// True when one more expansion is within the budget; false ends the search.
  bool spend() {
    if (spent_ >= budget_.expansions || budget_.stop.stop_requested()) return false;
    if (spent_ % 1024 == 0 && late()) return false;
    ++spent_;
    return true;
  }
  [[nodiscard]] std::uint64_t spent() const { return spent_; }
  /// Why spend() said no: budget_exhausted or cancelled.
  [[nodiscard]] tl::unexpected<Fault> refusal() const;

 private:
  [[nodiscard]] bool late() const;

  Budget budget_;
  std::uint64_t spent_ = 0;
  std::chrono::steady_clock::time_point deadline_;
};

}  // namespace outrider
