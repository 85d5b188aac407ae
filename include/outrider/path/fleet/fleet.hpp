// Fleets: several robots on one grid, each from its start to its goal, without collisions.
//
// Time goes in steps. In a step each robot waits, or moves to one of the four neighbours of its cell; all
// move at once. Two robots must not be in the same cell at the same step, nor exchange their cells in one
// step. A robot may follow another one into the cell that it leaves. At its goal a robot stays and is in the
// way, unless it makes room and returns. Disks of a radius up to 0.35 cells never touch then: two that pass
// round a corner behind each other come as near as 0.707 cells.
//
// The cost of a robot is the number of steps until it is at its goal for good; that of a plan is the sum
// (sum of costs). Only grids of the model `cells`. Source of the terms: Stern et al., Multi-agent
// pathfinding: definitions, variants, and benchmarks (2019).
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "outrider/path/grid/grid_map.hpp"

namespace outrider {

/// The largest number of robots, and of robots times cells.
inline constexpr std::size_t most_fleet_robots = 2000;
inline constexpr std::size_t most_fleet_distances = std::size_t{1} << 27U;

/// A start and a goal for each robot, m.
struct FleetProblem {
  std::shared_ptr<const GridMap> grid;
  std::vector<Vec2> starts;
  std::vector<Vec2> goals;
};

/// The paths of all robots.
struct FleetPlan {
  std::vector<std::vector<Cell>> paths;  ///< by robot: its cell at step 0, 1, ...; all are equally long
  std::uint64_t cost = 0;                ///< sum of costs, steps
  std::uint64_t lower_bound = 0;         ///< proven: no plan of all robots costs less
  std::uint64_t expansions = 0;          ///< work of the search
  friend bool operator==(const FleetPlan&, const FleetPlan&) = default;
};

/// Returns the number of steps until the robot is at the end of its path for good.
std::uint64_t arrival_step(const std::vector<Cell>& path);

/// Verifies a plan by the definition above: each path leads from the start to the goal over free cells by
/// legal moves, no two robots collide (every pair, at every step), the cost is the sum, and the lower bound
/// is not above it. It shares no code with the planners. O(robots^2 * steps). Fault: bad_input that names
/// robots and step.
Status check(const FleetPlan& plan, const FleetProblem& problem);

}  // namespace outrider
