// The visibility graph of routes.hpp: its nodes and their lines of sight.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "outrider/core/budget.hpp"
#include "outrider/core/outcome.hpp"
#include "outrider/motion/robot_model.hpp"
#include "outrider/world/collision_map.hpp"

namespace outrider::routes {

struct SightLine {
  std::uint32_t to = 0;
  double heading_rad = 0.0;
  double drive_s = 0.0;
};

/// The sight lines of each point, row by row, ascending in `to`.
struct SightLines {
  std::vector<std::size_t> first = {0};
  std::vector<SightLine> lines;

  [[nodiscard]] std::span<const SightLine> row(std::size_t i) const {
    return {lines.data() + first[i], lines.data() + first[i + 1]};
  }
};

/// A place where a route may bend: a corner of an obstacle grown by the robot, or a place in the open.
struct Node {
  Vec2 at;
  Vec2 before = at;  ///< the corner before it, counter-clockwise; a node in the open has none
  Vec2 after = at;   ///< the corner after it

  /// Returns true if a straight leg to or from the place touches the node as a tangent: the grown obstacle
  /// lies on one side of it. A route that is pulled taut has no other legs. In the open, every leg does.
  [[nodiscard]] bool is_touched_from(Vec2 place) const;
};

/// Returns places in the open as nodes.
std::vector<Node> open_nodes(const std::vector<Vec2>& places);

/// Returns the free corners around the obstacles and the free nodes of `extra`, sorted by x, then y; no two
/// are at the same place. Of more than 2048 corners, as around meshes of many triangles, one stands for those
/// within a sixteenth of the radius, then an eighth, then a quarter. A node that stands for several counts as
/// a place in the open.
std::vector<Node> route_nodes(const CollisionMap& ground, double radius_m, double arc_step_rad,
                              const std::vector<Vec2>& extra);

/// Points nearer to each other than this are the same place: no leg joins them.
inline constexpr double same_place_m = 1e-9;

/// Finds the nodes of `to` that each node of `from` sees along a leg that touches both; O(from x to) exact
/// tests, in parallel.
Outcome<SightLines> sight_lines(const CollisionMap& ground, const RobotModel& robot,
                                const std::vector<Node>& from, const std::vector<Node>& to, Budget& budget);

/// Finds all such pairs of `nodes`.
Outcome<SightLines> sight_lines(const CollisionMap& ground, const RobotModel& robot,
                                const std::vector<Node>& nodes, Budget& budget);

/// Returns the same lines in the opposite direction.
SightLines reversed(const SightLines& lines, const std::vector<Node>& from, const std::vector<Node>& to);

}  // namespace outrider::routes
