// Routes: drive times between many stops, found together instead of one search a pair.
//
// The robot is a disk that turns in place, then drives straight, from rest to rest (RobotModel). It
// travels on a visibility graph. Its nodes are the free corners of polygons around the obstacles grown
// by the robot's radius (geometry/convex.hpp, circumscribed), at the step of the options and at twice
// that step (at most 90 degrees): the finer corners lie closer to the obstacle, the coarser ones need
// fewer halts. Its edges are the pairs of nodes and stops that a straight leg joins and that it touches as
// a tangent: a leg that enters the polygon of a corner belongs to no path that is pulled taut. Where there
// are more than 2048 corners, one stands for those within up to a quarter of the radius. A route does not
// pass through other stops.
//
// The cost of a route is the time of its legs and of the turns between them. A turn depends on the
// direction of arrival, so Dijkstra's algorithm settles pairs (node, heading); of two labels of a node
// the second is dropped when turning from the first to its heading costs no more than the difference
// (turning times are subadditive, so this loses nothing). One search from a stop answers for all stops.
//
// Guarantees:
// - Every leg is free of collisions, exactly (Ground::segment_free, contact within 1e-9 m).
// - The time is the least of all routes on this graph.
// - Length: let k = 1 / cos(step / 2), 1.08 at 45 degrees. A robot for which each rounded corner had a
//   radius k times as large, and which can stand on both stops, may get from one to the other: then a
//   route exists here, and one on the graph is no longer than that robot's shortest. (Up to 2048 corners.)
// - Narrower passages may be lost at the corners. Extra nodes, such as the cells of a grid path,
//   restore them: stops joined by a chain of free legs over extra nodes are always connected.
// - The route from j to i is the route from i to j reversed. Same input, same bytes, any number of
//   threads.
//
// Source: Lozano-Perez and Wesley, Communications of the ACM 22(10), 1979 (visibility graphs of grown
// obstacles); Hansen, Bicriterion path problems, 1980 (labels and dominance).
#pragma once

#include <cstddef>
#include <memory>
#include <utility>
#include <vector>

#include "outrider/core/budget.hpp"
#include "outrider/core/options.hpp"
#include "outrider/core/outcome.hpp"
#include "outrider/core/units.hpp"
#include "outrider/geometry/pose.hpp"
#include "outrider/motion/drive.hpp"
#include "outrider/motion/robot_model.hpp"
#include "outrider/world/collision_map.hpp"

namespace outrider {

/// Options of routes.
struct RouteOptions {
  double arc_step_rad = pi / 4;  ///< turn per corner around a rounded obstacle, 1 to 90 degrees
};

std::vector<Option> describe(RouteOptions& options);

/// A route between two places.
struct Route {
  std::vector<Vec2> waypoints;  ///< from the start to the goal, both included
  DriveCost cost;               ///< cost including the first turn
};

struct RouteTable;

/// The routes between a list of stops, for one ground and robot. Immutable, cheap to copy, and safe to query
/// from several threads at once.
class Routes {
 public:
  explicit Routes(std::shared_ptr<const RouteTable> table) : table_(std::move(table)) {}

  /// Returns the drive between two stops. O(1).
  [[nodiscard]] Drive between(std::size_t from, std::size_t to) const;
  /// Returns the waypoints between two stops, both included: one point if both stops are at the same place,
  /// none if there is no route. O(waypoints).
  [[nodiscard]] std::vector<Vec2> waypoints(std::size_t from, std::size_t to) const;
  /// Returns the fastest route on the same graph between points that need not be stops, including the first
  /// turn. A* that looks at O(nodes) legs and tests only promising ones. One expansion is one of these, or a
  /// label; a free straight line takes none. Faults: start_blocked, goal_blocked, outside_map, bad_input,
  /// no_path; those of the budget.
  [[nodiscard]] Outcome<Route> route(const Pose2& start, Vec2 goal, const Budget& budget = {}) const;

 private:
  std::shared_ptr<const RouteTable> table_;
};

struct CornerTable;

/// The nodes of a ground for one robot, with what they see of each other: the part of routes that is the same
/// for every list of stops. Immutable and cheap to copy.
class Corners {
 public:
  explicit Corners(std::shared_ptr<const CornerTable> table) : table_(std::move(table)) {}

  /// Returns the robot that the nodes have room for.
  [[nodiscard]] const RobotModel& robot() const;
  [[nodiscard]] std::size_t size() const;
  [[nodiscard]] const std::shared_ptr<const CornerTable>& table() const { return table_; }

 private:
  std::shared_ptr<const CornerTable> table_;
};

/// Finds the corners of the ground, adds `extra_nodes` (those that are not free are skipped), and finds which
/// of them see each other. Faults: bad_input for numbers that are not finite or more than 16,384 nodes; those
/// of the budget. One expansion is a node whose lines of sight are found. O(n^2) exact sight tests, O(n^2)
/// memory at worst.
Outcome<Corners> find_corners(const CollisionMap& ground, const RobotModel& robot,
                              const std::vector<Vec2>& extra_nodes, const RouteOptions& options,
                              const Budget& budget);

/// Searches from every stop. Faults: goal_blocked for a blocked stop and outside_map for a stop outside the
/// bounds, with its index; bad_input for numbers that are not finite or more than 2048 stops; those of the
/// budget. One expansion is a stop whose lines of sight are found, or a settled label. Time: O(s (n + s))
/// exact sight tests and O(s n^2) relaxations at worst for n nodes and s stops. Memory: O(s n + s^2).
Outcome<Routes> routes_between(const Corners& corners, const std::vector<Vec2>& stops, const Budget& budget);

/// Both together. The budget counts for the sum.
Outcome<Routes> routes_between(const CollisionMap& ground, const RobotModel& robot,
                               const std::vector<Vec2>& stops, const std::vector<Vec2>& extra_nodes,
                               const RouteOptions& options, const Budget& budget);

}  // namespace outrider
