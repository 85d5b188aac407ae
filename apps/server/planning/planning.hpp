// A path planning question as JSON, and its answer: the plan, checked, with details of the search.
#pragma once

#include <chrono>
#include <stop_token>

#include "outrider/jobs/plan/scenario.hpp"
#include "outrider/search/workspace.hpp"
#include "planning/ground.hpp"

namespace outrider::server {

inline constexpr std::int64_t most_traced = 100'000;
inline constexpr std::chrono::seconds longest_planning{10};

/// Holds what questions share. Thread rule: any thread may use it.
struct PlanningMemory {
  MapStore maps;
  GroundStore grounds;
};

/// Answers {"map" or "grid" or "polygons", "edits", "start", "goal", "planner", "options", "model",
/// "radius_m", "resolution_m", "trace", "blocked", "legs"} with the object that `outrider plan --json`
/// prints, with one row, and "view": {"trace", "blocked", "legs"}, as far as requested. A missing path or a
/// blocked start or goal is a valid answer; its code is the status of the row. Faults: bad_input on an
/// invalid request; cancelled. `workspace` keeps what a planner built for the next question on the same
/// ground.
Outcome<Json> answer_plan(const Json& request, PlanningMemory& memory, Workspace& workspace,
                          const std::stop_token& stop);

/// Holds a question as a scenario, and its map with the edits applied.
struct QuestionScenario {
  PlanScenario scenario;  ///< complete except for `map`, the file name
  KnownMap map;
};

/// Converts a request of answer_plan() to a scenario. Fault: bad_input on an invalid request.
Outcome<QuestionScenario> scenario_of_question(const Json& request, PlanningMemory& memory);

}  // namespace outrider::server
