// Ways around what stands in the way and is not on the map: other robots, and things that were noticed.
#pragma once

#include <optional>
#include <vector>

#include "outrider/jobs/guard/yard/firing_map.hpp"

namespace outrider {

/// Returns the fastest way from one place to another that keeps `gap_m` from the middles of what is
/// `standing` there; nothing if none was found, or the budget ended first. It is that of routes_between()
/// with disks about the middles among the obstacles, which must leave room for the robot at both places.
std::optional<std::vector<Vec2>> way_around(const GuardProblem& problem, const FiringMap& firing_map,
                                            Vec2 from, Vec2 to, const std::vector<Vec2>& standing,
                                            double gap_m, const Budget& budget = {});

}  // namespace outrider
