#include "outrider/core/planner_outage.hpp"

namespace outrider {

Budget PlannerOutage::budget(double time_s) const {
  Budget budget;
  if (time_s >= from_s && time_s < from_s + for_s) budget.expansions = 0;
  return budget;
}

std::vector<Option> describe(PlannerOutage& outage) {
  return {
      {"planner_fails_from", "s", 0.0, 1e9, "from then on the path planner runs out of its budget",
       &outage.from_s},
      {"planner_fails_for", "s", 0.0, 1e9, "for how long", &outage.for_s},
  };
}

}  // namespace outrider
