// A whole pursuit, simulated, until the catch or the target's last second.
#pragma once

#include <functional>
#include <vector>

#include "outrider/jobs/pursue/mission.hpp"

namespace outrider {

/// Runs the mission. Faults: those of check(problem) for any robot; no_path when it is proven at the start
/// that no robot can ever catch the target; those of the planner in its first call. A mission that ends
/// without a catch is no fault. `look` is shown the run so far, whenever a second has passed or planning
/// knows more; nothing of it changes what happens.
Outcome<PursuitRun> pursue(const PursuitProblem& truth, const std::vector<Cell>& robots,
                           const PursuitRules& rules, StopWatch& watch,
                           const std::function<void(const PursuitRun&)>& look = {});

/// Cells for a team: the first as given, each next one the free cell farthest in king's moves, as if there
/// were no walls, from all before it; the lowest row and then column among equals. O(cells count).
std::vector<Cell> place_team(const PursuitProblem& problem, std::size_t count);

}  // namespace outrider
