// Ways around what stands in the way and is not on the map: other robots, and things that were noticed.
#pragma once

#include <optional>
#include <vector>

#include "outrider/jobs/guard/yard/firing_map.hpp"

namespace outrider {

/// Returns a way from one place to another that is free for the robot and keeps `gap_m` from the middles of
/// what is `standing` there; nothing if none was found, or the budget ended first. It is not the shortest:
/// the shortest chain of neighbouring reachable cells, found with A*, whose legs are joined from its
/// beginning on, as far as they stay free. O(cells log cells).
std::optional<std::vector<Vec2>> way_around(const GuardProblem& problem, const FiringMap& firing_map,
                                            Vec2 from, Vec2 to, const std::vector<Vec2>& standing,
                                            double gap_m, const Budget& budget = {});

}  // namespace outrider
