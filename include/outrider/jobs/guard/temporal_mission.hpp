// The temporal problem of a yard, with our own answer to it.
#pragma once

#include <vector>

#include "outrider/jobs/guard/problem.hpp"
#include "outrider/jobs/guard/supply_plan.hpp"
#include "outrider/jobs/guard/temporal.hpp"

namespace outrider {

struct TemporalMission {
  TemporalProblem problem;
  std::vector<std::size_t> targets;   ///< by goal
  std::vector<Vec2> places;           ///< by stop
  std::vector<StationCall> calls;     ///< by station
  std::vector<std::size_t> left_out;  ///< targets that are no goals: nothing hits them, or our tour does not
  std::vector<SupplyStep> steps;      ///< the best tour found, by the solvers of tour/
  double cost_s = 0.0;                ///< of the steps, under the model of tour/
  double lower_bound_s = 0.0;         ///< 0 on finite supplies, unless proven
  bool proven = false;                ///< no tour takes less
};

/// Over the stops of `plan` (that for supplies without end), at most `stops` others, and the stations where
/// the supplies end. Shots are from a standstill. Refused: as supply_table() and temporal_problem(); no_shot
/// when no target can be hit.
Outcome<TemporalMission> temporal_mission(const GuardProblem& problem, const FiringMap& firing_map,
                                          const GuardPlan& plan, const GuardOptions& options,
                                          std::size_t stops, const Budget& budget);

}  // namespace outrider
