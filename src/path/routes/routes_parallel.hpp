// A shared budget for parallel work, whose outcome does not depend on the number of threads.
#pragma once

#include <algorithm>
#include <chrono>
#include <vector>

#include "outrider/core/budget.hpp"
#include "outrider/core/parallel.hpp"

namespace outrider::routes {

/// Calls work(i, meter) -> bool for i = 0 ... count - 1, block by block, each with its own meter on the
/// remaining budget; false means that the meter refused. The expansions spent are subtracted from `remaining`
/// in the order of i.
template <class Work>
Status in_parallel(std::size_t count, Budget& remaining, Work work) {
  constexpr std::size_t block = 64;
  const auto begin = std::chrono::steady_clock::now();
  const auto wall_time = remaining.wall_time;
  for (std::size_t low = 0; low < count; low += block) {
    const std::size_t size = std::min(block, count - low);
    std::vector<BudgetMeter> meters(size, BudgetMeter(remaining));
    std::vector<char> done(size, 0);
    parallel_for(size, [&](std::size_t k) { done[k] = work(low + k, meters[k]) ? 1 : 0; });
    for (std::size_t k = 0; k < size; ++k) {
      if (remaining.stop.stop_requested()) return meters[k].refusal();
      if (done[k] == 0 || meters[k].spent() > remaining.expansions) {
        return fault(FaultCode::budget_exhausted, "the budget ended among the routes; give a larger one");
      }
      remaining.expansions -= meters[k].spent();
    }
    if (wall_time) remaining.wall_time = *wall_time - (std::chrono::steady_clock::now() - begin);
  }
  return {};
}

}  // namespace outrider::routes
