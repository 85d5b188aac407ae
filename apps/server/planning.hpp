// A question of a path planner as JSON, and its answer: the plan, judged, with what the search did.
#pragma once

#include <chrono>
#include <stop_token>

#include "ground.hpp"
#include "outrider/jobs/plan/scenario.hpp"
#include "outrider/search/workspace.hpp"

namespace outrider::server {

inline constexpr std::int64_t most_traced = 100'000;
inline constexpr std::chrono::seconds longest_planning{10};

/// What questions share. Thread rule: any thread may use it.
struct PlanningMemory {
  MapStore maps;
  GroundStore grounds;
};

/// {"map" or "grid" or "polygons", "edits", "start", "goal", "planner", "options", "model", "radius_m",
/// "resolution_m", "trace", "blocked", "legs"} -> the object that `outrider plan --json` prints, with one
/// row, and "view": {"trace", "blocked", "legs"}, what of these was asked for. That there is no path, or that
/// the start or the goal is blocked, is an answer, and its code the status of the row. Faults: bad_input on a
/// request that is wrong; cancelled. `workspace` keeps what a planner built for the next question on the same
/// ground.
Outcome<Json> answer_plan(const Json& request, PlanningMemory& memory, Workspace& workspace,
                          const std::stop_token& stop);

/// A question as a scenario, and the map that it asks about with the edits in it.
struct QuestionScenario {
  PlanScenario scenario;  ///< but for `map`, the name of a file
  KnownMap map;
};

/// Of the same request as answer_plan(). Fault: bad_input on one that is wrong.
Outcome<QuestionScenario> scenario_of_question(const Json& request, PlanningMemory& memory);

}  // namespace outrider::server
