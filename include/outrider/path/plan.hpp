// Plan: the output of a path planner.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "outrider/path/problem.hpp"

namespace outrider {

/// Counts of the work done by a planner. They are the same in every run.
struct PlanCounters {
  std::uint64_t expansions = 0;            ///< expanded states
  std::uint64_t generated = 0;             ///< neighbours considered
  std::uint64_t line_of_sight_checks = 0;  ///< lines of sight tested
  friend bool operator==(const PlanCounters&, const PlanCounters&) = default;
};

/// A straight leg or an arc of an exact path.
struct PathPiece {
  Vec2 from;
  Vec2 to;
  Vec2 centre;            ///< centre of the arc; unused for a leg
  double turn_rad = 0.0;  ///< angle of the arc, counter-clockwise positive; 0 for a leg
  bool backward = false;  ///< the robot drives it in reverse, so it looks against the direction of travel
  friend bool operator==(const PathPiece&, const PathPiece&) = default;
};

/// Returns the length of a piece, m.
double length_of(const PathPiece& piece);

/// Returns the angle between the final direction of a piece and the initial direction of the next, rad, from
/// 0 to pi.
double turn_between(const PathPiece& piece, const PathPiece& next);

/// The weights of the cost of a path. By default the cost is the length, m. Planners of fastest paths and of
/// safe paths set other weights.
struct CostWeights {
  double per_m = 1.0;                 ///< cost per metre
  double per_rad = 0.0;               ///< cost per radian of turning, in place or along an arc
  std::optional<double> heading_rad;  ///< initial heading; if unset, the first turn costs nothing
  double per_exposure_m = 0.0;        ///< cost per unit of exposure, the integral of 1 / clearance
  double per_cusp = 0.0;              ///< cost of each change between driving forwards and backwards
  double per_backward_m = 0.0;        ///< cost per metre driven backwards, in addition to `per_m`
  bool by_cell = false;               ///< a metre costs `per_m` times the cost of its cell (Problem::costs)
  friend bool operator==(const CostWeights&, const CostWeights&) = default;
};

/// The motions of a robot that steers.
struct Steering {
  double turning_radius_m = 0.0;  ///< least radius of its arcs
  bool reverse = false;           ///< it can drive backwards
  /// Set if the ends are those of a lattice: the path begins and ends within half a cell of a grid of the
  /// given points along each axis, and within this angle of the given headings. Unset: exactly there.
  std::optional<double> snap_rad = std::nullopt;
  friend bool operator==(const Steering&, const Steering&) = default;
};

/// A path with its cost and a proven lower bound.
struct Plan {
  std::vector<Vec2> waypoints;    ///< start, points where the path turns, and goal, m
  std::vector<Cell> vertices;     ///< the waypoints as vertices of the grid; empty if there are pieces
  double cost = 0.0;              ///< cost of the path under `weights`: its length, m, or its time, s
  double lower_bound = 0.0;       ///< proven: no path of the planner's class costs less
  double reached_within = 0.0;    ///< distance from the last waypoint to the requested goal, m
  PlanCounters counters;          ///< work done
  std::vector<PathPiece> pieces;  ///< the exact path, on polygons or of a robot that steers; else empty
  double waypoint_error_m = 0.0;  ///< largest distance of the legs between waypoints from the pieces
  CostWeights weights;            ///< weights of the cost
  double exposure = 0.0;          ///< exposure as the planner counts it, if `weights` has a weight for it
  /// Set for a robot that cannot turn in place: the path then consists of `pieces` that it can drive, on a
  /// grid too, and `vertices` is empty.
  std::optional<Steering> steering = std::nullopt;
  std::string remark = {};  ///< a sentence about how the answer came about, for a person; empty as a rule
  friend bool operator==(const Plan&, const Plan&) = default;
};

/// Returns the length of the path, m: of its pieces, or of the legs between its waypoints if it has no
/// pieces.
double length_of(const Plan& plan);

/// Makes a plan from vertices, of which neighbours may be equal. Its waypoints are the vertices at which the
/// direction changes.
Plan plan_along(const Problem& problem, const std::vector<Cell>& vertices, double cost, double lower_bound,
                const PlanCounters& counters);

}  // namespace outrider
