// PlanTask: a checked scenario of the job `plan`, with its map.
#pragma once

#include <set>
#include <stop_token>
#include <string>
#include <vector>

#include "outrider/jobs/plan/answer.hpp"
#include "outrider/jobs/plan/scenario.hpp"

namespace outrider {

/// The scenario, its map, and what to plan.
struct PlanTask {
  PlanScenario settled;  ///< the scenario with the defaults of its map
  LoadedMap map;
  std::vector<ChosenPlanner> planners;  ///< planners to run
  std::vector<PlanQuery> queries;
  PlanGroundOptions ground;
};

/// Reads the map and parses the scenario; `given` holds the keys that were set. A world of solids is
/// converted to polygons if the planner accepts these. Faults: bad_input with the file, or with the key.
Outcome<PlanTask> load_plan(const PlanScenario& scenario, const std::set<std::string>& given);

/// Makes the ground and the queries of the task. Faults: those of plan_ground().
Outcome<PlanQuestion> question_of(const PlanTask& task, const std::stop_token& stop = {});

}  // namespace outrider
