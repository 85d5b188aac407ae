// The third table of the suite `guard`: missions of several robots, beside that of one.
#pragma once

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/jobs/guard/scenario.hpp"
#include "suites.hpp"

namespace outrider::bench {

struct TeamRow {
  std::string yard;
  std::int64_t robots = 1;
  std::int64_t runs = 0;
  double reached = 0.0;     ///< targets, mean over the runs
  double failed = 0.0;      ///< targets, mean over the runs
  double planning_s = 0.0;  ///< firing map and plan
  double planned_s = 0.0;   ///< makespan of the plan
  double mission_s = 0.0;   ///< mean over the runs
  double lower_bound_s = 0.0;
  double waited_s = 0.0;   ///< of all robots, mean over the runs
  double closest_m = 0.0;  ///< the nearest two robots of all runs; infinite: one robot
  double ratio = 0.0;      ///< planned time relative to that of one robot
};

/// Plans for 1 to `robots` robots in each yard, with starts beside the first, and simulates each plan with
/// seeds 1 to `seeds`. Faults: those of build_firing_map(), plan_guard() and plan_team().
Outcome<std::vector<TeamRow>> measure_teams(const std::vector<GuardScenario>& yards, std::int64_t robots,
                                            std::int64_t seeds, const BenchObserver& observer);

std::string teams_table(const std::vector<TeamRow>& rows);
nlohmann::ordered_json teams_json(const std::vector<TeamRow>& rows);

}  // namespace outrider::bench
