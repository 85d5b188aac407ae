// The visibility graph of routes.hpp: nodes, and who sees whom.
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

/// The free corners around the obstacles, then the free ones of `extra`; no two in one place.
std::vector<Vec2> route_nodes(const CollisionMap& ground, double radius_m, double arc_step_rad,
                              const std::vector<Vec2>& extra);

/// Points nearer to each other than this are one place: no leg joins them.
inline constexpr double same_place_m = 1e-9;

/// Which points of `to` each point of `from` sees; O(from x to) exact tests, in parallel.
Outcome<SightLines> sight_lines(const CollisionMap& ground, const RobotModel& robot,
                                const std::vector<Vec2>& from, const std::vector<Vec2>& to, Budget& budget);

/// Who sees whom among `points`.
Outcome<SightLines> sight_lines(const CollisionMap& ground, const RobotModel& robot,
                                const std::vector<Vec2>& points, Budget& budget);

/// The same lines from their other ends.
SightLines reversed(const SightLines& lines, const std::vector<Vec2>& from, const std::vector<Vec2>& to);

}  // namespace outrider::routes
