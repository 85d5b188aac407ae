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

/// Returns the free corners around the obstacles, then the free nodes of `extra`; no two are at the same
/// place.
std::vector<Vec2> route_nodes(const CollisionMap& ground, double radius_m, double arc_step_rad,
                              const std::vector<Vec2>& extra);

/// Points nearer to each other than this are the same place: no leg joins them.
inline constexpr double same_place_m = 1e-9;

/// Finds the points of `to` that each point of `from` sees; O(from x to) exact tests, in parallel.
Outcome<SightLines> sight_lines(const CollisionMap& ground, const RobotModel& robot,
                                const std::vector<Vec2>& from, const std::vector<Vec2>& to, Budget& budget);

/// Finds all pairs of `points` that see each other.
Outcome<SightLines> sight_lines(const CollisionMap& ground, const RobotModel& robot,
                                const std::vector<Vec2>& points, Budget& budget);

/// Returns the same lines in the opposite direction.
SightLines reversed(const SightLines& lines, const std::vector<Vec2>& from, const std::vector<Vec2>& to);

}  // namespace outrider::routes
