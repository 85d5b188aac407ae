// The temporal problem of a yard, together with Outrider's own solution.
#pragma once

#include <vector>

#include "outrider/jobs/guard/plan/supply_plan.hpp"
#include "outrider/jobs/guard/problem.hpp"
#include "research/guard/temporal.hpp"

namespace outrider {

/// A temporal problem and its solution.
struct TemporalMission {
  TemporalProblem problem;
  std::vector<std::size_t> targets;  ///< target of each goal
  std::vector<Vec2> places;          ///< position of each stop
  std::vector<StationCall> calls;    ///< station and store of each station stop
  std::vector<std::size_t>
      left_out;                   ///< targets that are no goals: they cannot be hit, or the tour omits them
  std::vector<SupplyStep> steps;  ///< the best tour found by the solvers of tour/
  double cost_s = 0.0;            ///< time of the steps in the model of tour/
  double lower_bound_s = 0.0;     ///< 0 with limited supplies, unless the tour is proven optimal
  bool proven = false;            ///< the tour is optimal
};

/// Makes the problem over the stops of `plan` (a plan for unlimited supplies), up to `stops` further stops,
/// and the stations if supplies are limited. All shots are fired at rest. Faults: those of supply_table() and
/// temporal_problem(); no_shot if no target can be hit.
Outcome<TemporalMission> temporal_mission(const GuardProblem& problem, const FiringMap& firing_map,
                                          const GuardPlan& plan, const GuardOptions& options,
                                          std::size_t stops, const Budget& budget);

}  // namespace outrider
