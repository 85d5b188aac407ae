// Plan: what a path planner answers.
#pragma once

#include <cstdint>
#include <vector>

#include "outrider/path/problem.hpp"

namespace outrider {

/// Work done, in numbers that repeat exactly.
struct PlanCounters {
  std::uint64_t expansions = 0;
  std::uint64_t generated = 0;  ///< neighbours looked at
  std::uint64_t line_of_sight_checks = 0;
  friend bool operator==(const PlanCounters&, const PlanCounters&) = default;
};

/// A straight leg or an arc of an exact path.
struct PathPiece {
  Vec2 from;
  Vec2 to;
  Vec2 centre;            ///< of an arc
  double turn_rad = 0.0;  ///< of an arc, counter-clockwise positive; 0 for a leg
  friend bool operator==(const PathPiece&, const PathPiece&) = default;
};

/// Length of a piece, m.
double length_of(const PathPiece& piece);

struct Plan {
  std::vector<Vec2> waypoints;  ///< from the start's vertex to the goal's, where the path turns, m
  std::vector<Cell> vertices;   ///< the same as vertices of the grid; none on polygons
  double cost = 0.0;            ///< length of the path, m
  double lower_bound = 0.0;     ///< proven: no path of the planner's class is shorter, m
  double reached_within = 0.0;  ///< from the last waypoint to the goal that was asked for, m
  PlanCounters counters;
  std::vector<PathPiece> pieces;  ///< the path itself on polygons; none on a grid, where the waypoints are it
  double waypoint_error_m = 0.0;  ///< no point of the legs between waypoints is farther from the pieces
  friend bool operator==(const Plan&, const Plan&) = default;
};

/// The plan along those vertices: waypoints where the direction changes, cost and bound as given.
Plan plan_along(const Problem& problem, const std::vector<Cell>& vertices, double cost, double lower_bound,
                const PlanCounters& counters);

}  // namespace outrider
