// The log of an answer: the ground, the paths, and what a search expanded.
#pragma once

#include <string>

#include "outrider/core/trace.hpp"
#include "outrider/jobs/plan/answer.hpp"
#include "outrider/jobs/plan/task.hpp"
#include "outrider/log/log.hpp"

namespace outrider {

/// Logs the ground: the solids of a world, the walls of polygons, or the cells of a map; the cells that the
/// centre of the robot must not enter; the costs of the ground, unless its grid is turned; starts, goals, and
/// the paths of each planner on "/plan/NAME". If there is a trace, logs when the search expanded each cell.
/// All messages have the time 0. O(cells + points of the paths + expansions).
void log_answer(Log& log, const PlanTask& task, const PlanQuestion& question, const PlanAnswer& answer,
                const Trace* trace);

/// The vertices in the order in which the search expanded them, as a JSON array; costs in cells.
std::string trace_json(const Trace& trace, const GridMap& ground);

}  // namespace outrider
