// Budget: the limit on the work of a planner. Every planner takes one.
//
// Prefer a limit on expansions, because it gives the same result on every machine. Wall time is unlimited by
// default, so that it never changes a result unintentionally.
#pragma once

#include <chrono>
#include <cstdint>
#include <limits>
#include <optional>
#include <stop_token>

#include "outrider/core/outcome.hpp"

namespace outrider {

/// Limits of a search; the first that is reached ends it.
struct Budget {
  std::uint64_t expansions = std::numeric_limits<std::uint64_t>::max();  ///< maximum number of expansions
  std::optional<std::chrono::nanoseconds> wall_time;                     ///< maximum time; unset: unlimited
  std::stop_token stop;                                                  ///< cancels the search
};

/// Counts expansions against a budget. It checks the stop token at every expansion and the clock at every
/// 1024th.
class BudgetMeter {
 public:
  explicit BudgetMeter(const Budget& budget);

  /// Counts one expansion. Returns false if the budget is used up; the search must end then.
  bool spend() {
    if (spent_ >= budget_.expansions || budget_.stop.stop_requested()) return false;
    if (spent_ % 1024 == 0 && late()) return false;
    ++spent_;
    return true;
  }
  [[nodiscard]] std::uint64_t spent() const { return spent_; }
  /// Returns the fault for a search whose spend() returned false: budget_exhausted or cancelled.
  [[nodiscard]] tl::unexpected<Fault> refusal() const;

 private:
  [[nodiscard]] bool late() const;

  Budget budget_;
  std::uint64_t spent_ = 0;
  std::chrono::steady_clock::time_point deadline_;
};

}  // namespace outrider
