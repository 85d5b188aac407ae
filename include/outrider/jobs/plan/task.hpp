// The task of the job plan: a scenario that was read and understood, and its map.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "outrider/jobs/plan/answer.hpp"
#include "outrider/jobs/plan/scenario.hpp"

namespace outrider {

struct PlanTask {
  PlanScenario settled;  ///< with the defaults of its map
  LoadedMap map;
  std::vector<ChosenPlanner> planners;  ///< to ask
  std::vector<PlanQuery> queries;
  PlanGroundOptions ground;
};

/// Reads the map and what the scenario asks; `given` holds the keys that were set. A world of solids is taken
/// as polygons where its planner takes those. Faults: bad_input with the file, or with the key.
Outcome<PlanTask> load_plan(const PlanScenario& scenario, const std::set<std::string>& given);

/// The ground of the task, and what is asked on it. Faults: those of plan_ground().
Outcome<PlanQuestion> question_of(const PlanTask& task);

}  // namespace outrider
