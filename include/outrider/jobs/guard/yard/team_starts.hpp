// Starts of the robots of a team: the first at the start of the problem, the others as given or beside it.
#pragma once

#include <cstdint>
#include <vector>

#include "outrider/jobs/guard/yard/firing_map.hpp"

namespace outrider {

inline constexpr std::int64_t most_robots = 5;

/// Returns the starts of `robots` robots: that of the problem and the `others`. If there are no others, they
/// are chosen: the centres of reachable cells with the heading of the first robot, one after another. Each is
/// at least 2 simulated_gap_m() from those before, so that every robot can turn aside, or once that if there
/// is not enough room; and it has the least sum of its distance to the left or right of the first robot and
/// twice its distance ahead of it or behind. O(cells * robots). Faults: those of check_starts() at
/// `robot_starts`; bad_input at `robots` if there is not enough room.
Outcome<std::vector<Pose2>> starts_of_team(const GuardProblem& problem, const FiringMap& firing_map,
                                           std::size_t robots, const std::vector<Pose2>& others);

}  // namespace outrider
