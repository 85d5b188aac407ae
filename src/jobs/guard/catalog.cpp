#include "outrider/jobs/guard/catalog.hpp"

#include <string>

namespace outrider {
namespace {

std::vector<GuardPlanner>& rows() {
  static std::vector<GuardPlanner> planners = {
      {"best_tour",
       "The best tour over places from where several targets are hit for sure, looked at closer and closer.",
       "Noon and Bean, A Lagrangian based approach for the asymmetric generalized traveling salesman "
       "problem, "
       "1991; docs/jobs/guard.md",
       plan_guard,
       "each target is in one stop or no shot at it was found at the resolution, each shot hits with the "
       "margin, "
       "each leg is free; the tour comes with a proven bound of its time over the chosen stops"},
  };
  return planners;
}

}  // namespace

const std::vector<GuardPlanner>& guard_planners() { return rows(); }

void add_guard_planner(const GuardPlanner& row) { rows().push_back(row); }

Outcome<GuardPlanner> find_guard_planner(std::string_view name) {
  return find_row(guard_planners(), "planner", name, "plan.planner");
}

}  // namespace outrider
