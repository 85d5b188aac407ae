#include "outrider/jobs/guard/catalog.hpp"

#include <string>

#include "outrider/jobs/guard/reference.hpp"

namespace outrider {
namespace {

/// A method that has nothing to tell before it is done.
template <auto Planner>
Outcome<GuardPlan> at_once(const GuardProblem& problem, const FiringMap& firing_map,
                           const GuardOptions& options, const Budget& budget, const DraftObserver&) {
  return Planner(problem, firing_map, options, budget);
}

}  // namespace

const std::vector<GuardPlanner>& guard_planners() {
  static const std::vector<GuardPlanner> planners = {
      {"best_tour",
       "The best tour over places from where several targets are hit for sure, looked at closer and closer.",
       "Noon and Bean, A Lagrangian based approach for the asymmetric generalized traveling salesman "
       "problem, "
       "1991; docs/jobs/guard.md",
       plan_guard,
       "each target is in one stop or no shot at it was found at the resolution, each shot hits with the "
       "margin, "
       "each leg is free; the tour comes with a proven bound of its time over the chosen stops"},
      {"shrinking_circles",
       "For each target the first place found on circles that shrink around it; groups of targets as listed, "
       "each in its best order.",
       "the method of the reference report, from its description", at_once<shrinking_circles>},
      {"circles_in_order", "The places of shrinking_circles in the best order of all targets.",
       "shrinking_circles with the tour solver", at_once<circles_in_order>},
      {"source_target_table",
       "A table of places and the targets hit from there, looked up; always the nearest place next.",
       "the abstract of the reference report, from its description", at_once<source_target_table>},
  };
  return planners;
}

Outcome<GuardPlanner> find_guard_planner(std::string_view name) {
  return find_row(guard_planners(), "planner", name, "plan.planner");
}

}  // namespace outrider
