// PlannerOutage: a time in which the path planner of a mission has no budget, as if it were used up by
// others.
#pragma once

#include <vector>

#include "outrider/core/budget.hpp"
#include "outrider/core/options.hpp"

namespace outrider {

struct PlannerOutage {
  double from_s = 1e9;  ///< from then on no search may expand anything
  double for_s = 1e9;   ///< for how long

  /// Returns true if an outage was asked for.
  [[nodiscard]] bool any() const { return from_s < PlannerOutage{}.from_s; }
  /// Returns the budget that the planner has at a time of the mission: none, or no limit.
  [[nodiscard]] Budget budget(double time_s) const;
};
std::vector<Option> describe(PlannerOutage& outage);

}  // namespace outrider
