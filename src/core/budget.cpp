#include "outrider/core/budget.hpp"

#include <fmt/format.h>

namespace outrider {

BudgetMeter::BudgetMeter(const Budget& budget) : budget_(budget) {
  if (budget_.wall_time) {
    deadline_ = std::chrono::steady_clock::now() +
                std::chrono::duration_cast<std::chrono::steady_clock::duration>(*budget_.wall_time);
  }
}

bool BudgetMeter::late() const { return budget_.wall_time && std::chrono::steady_clock::now() >= deadline_; }

tl::unexpected<Fault> BudgetMeter::refusal() const {
  if (budget_.stop.stop_requested()) {
    return fault(FaultCode::cancelled, "the search was cancelled by its caller");
  }
  return fault(FaultCode::budget_exhausted,
               fmt::format("the budget ended after {} expansions; give a larger one", spent_));
}

}  // namespace outrider
