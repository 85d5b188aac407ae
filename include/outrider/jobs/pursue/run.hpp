// pursue() simulates a whole pursuit until the catch or the target's last second.
#pragma once

#include <functional>
#include <vector>

#include "outrider/jobs/pursue/mission.hpp"
#include "outrider/jobs/pursue/navigated.hpp"

namespace outrider {

/// Runs the mission. Faults: those of check(problem) for any robot; no_path when it is proven at the start
/// that no robot can ever catch the target; those of the planner in its first call. A mission that ends
/// without a catch is no fault. `look` receives the run so far after each second and whenever planning
/// knows more; it does not change the run. The team suffers the faults, which the mission is not told; their
/// random numbers are drawn from the seed.
Outcome<PursuitRun> pursue(const PursuitProblem& truth, const std::vector<Cell>& robots,
                           const PursuitRules& rules, StopWatch& watch,
                           const std::function<void(const PursuitRun&)>& look = {},
                           const TeamFaults& faults = {}, std::uint64_t seed = 1);

/// The same by a robot that its navigator drives.
Outcome<PursuitRun> pursue(const PursuitProblem& truth, const PursuitRules& rules, NavigatedPursuer& robot,
                           StopWatch& watch, const std::function<void(const PursuitRun&)>& look = {});

/// Returns start cells for a team. The first is the given start. Each next one is the free cell with the
/// largest Chebyshev distance from all cells before it; among equals the one of the lowest row, then column.
/// O(cells count).
std::vector<Cell> place_team(const PursuitProblem& problem, std::size_t count);

}  // namespace outrider
