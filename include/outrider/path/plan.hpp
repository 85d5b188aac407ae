// Plan: what a path planner answers.
#pragma once

#include <cstdint>
#include <optional>
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

/// Angle between the direction in which a piece ends and the one in which the next begins, rad, 0 to pi.
double turn_between(const PathPiece& piece, const PathPiece& next);

/// What cost counts: the length alone, m, unless a planner of least time or of safe paths gives its prices.
struct CostWeights {
  double per_m = 1.0;
  double per_rad = 0.0;               ///< of turning, in place or along an arc
  std::optional<double> heading_rad;  ///< before the first leg; without one the first turn is free
  double per_exposure_m = 0.0;        ///< of the integral of 1 / clearance along the path
  friend bool operator==(const CostWeights&, const CostWeights&) = default;
};

struct Plan {
  std::vector<Vec2> waypoints;  ///< from the start's vertex to the goal's, where the path turns, m
  std::vector<Cell> vertices;   ///< the same as vertices of the grid; none on polygons
  double cost = 0.0;            ///< of the path at its fare: its length, m, or its time, s
  double lower_bound = 0.0;     ///< proven: no path of the planner's class costs less
  double reached_within = 0.0;  ///< from the last waypoint to the goal that was asked for, m
  PlanCounters counters;
  std::vector<PathPiece> pieces;  ///< the path itself on polygons; none on a grid, where the waypoints are it
  double waypoint_error_m = 0.0;  ///< no point of the legs between waypoints is farther from the pieces
  CostWeights fare;
  double exposure =
      0.0;  ///< the integral of 1 / clearance as the planner counts it, where the fare prices it
  friend bool operator==(const Plan&, const Plan&) = default;
};

/// Length of the path, m: of its pieces, or between its waypoints where it has none.
double length_of(const Plan& plan);

/// The plan along those vertices: waypoints where the direction changes, cost and bound as given.
Plan plan_along(const Problem& problem, const std::vector<Cell>& vertices, double cost, double lower_bound,
                const PlanCounters& counters);

}  // namespace outrider
