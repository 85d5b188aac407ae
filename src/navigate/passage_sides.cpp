#include "passage_sides.hpp"

#include <algorithm>
#include <cmath>

#include "navigate_grid.hpp"

namespace outrider {
namespace {

constexpr double ahead_part = 0.4;        // sine of the angle between the way and an obstacle that is ahead
constexpr double right_part = 1.0 / 3.0;  // of the width, from the preferred side, that is on the right side
constexpr std::int32_t none = -1;

/// Finds for each cell one with an obstacle that is nearest, or nearly so.
std::vector<std::int32_t> nearest_obstacles(const GridFrame& frame, const std::vector<Vec2>& obstacles) {
  std::vector<std::int32_t> nearest(frame.size(), none);
  for (const Vec2 place : obstacles) {
    const Cell cell = frame.cell_at(place);
    if (frame.contains(cell)) nearest[frame.index(cell)] = static_cast<std::int32_t>(frame.index(cell));
  }
  const auto away2 = [&](Cell from, std::int32_t to) {
    const Cell cell = frame.cell(static_cast<std::size_t>(to));
    const std::int64_t dx = cell.x - from.x, dy = cell.y - from.y;
    return dx * dx + dy * dy;
  };
  const auto take = [&](Cell at, int dx, int dy) {
    const Cell from{at.x + dx, at.y + dy};
    if (!frame.contains(from)) return;
    const std::int32_t theirs = nearest[frame.index(from)];
    std::int32_t& ours = nearest[frame.index(at)];
    if (theirs != none && (ours == none || away2(at, theirs) < away2(at, ours))) ours = theirs;
  };
  for (const int up : {1, -1}) {
    for (int row = 0; row < frame.height; ++row) {
      const int y = up > 0 ? row : frame.height - 1 - row;
      for (int x = 0; x < frame.width; ++x) {
        for (const int dx : {-1, 0, 1}) take({x, y}, dx, -up);
      }
      for (int x = 1; x < frame.width; ++x) take({x, y}, -1, 0);
      for (int x = frame.width - 2; x >= 0; --x) take({x, y}, 1, 0);
    }
  }
  return nearest;
}

}  // namespace

void find_wrong_sides(const GridFrame& frame, const std::vector<Vec2>& obstacles, double passage_m, int side,
                      std::vector<std::uint8_t>& wrong) {
  wrong.assign(frame.size(), 0);
  const std::vector<std::int32_t> nearest = nearest_obstacles(frame, obstacles);
  const double widest = passage_m / frame.resolution_m;  // in cells
  const auto is_obstacle = [&](Cell cell) {
    return frame.contains(cell) && nearest[frame.index(cell)] == static_cast<std::int32_t>(frame.index(cell));
  };
  for (std::size_t i = 0; i < frame.size(); ++i) {
    if (nearest[i] == none || nearest[i] == static_cast<std::int32_t>(i)) continue;
    const Cell at = frame.cell(i), to = frame.cell(static_cast<std::size_t>(nearest[i]));
    const Vec2 off{static_cast<double>(to.x - at.x), static_cast<double>(to.y - at.y)};
    const double away = norm(off);
    if (2.0 * away > widest) continue;
    const Vec2 back = (-1.0 / away) * off;
    const auto is_opposite = [&](double far) {
      return is_obstacle({at.x + static_cast<int>(std::lround(far * back.x)),
                          at.y + static_cast<int>(std::lround(far * back.y))});
    };
    double far = 1.0;
    while (far <= widest - away && !is_opposite(far)) far += 1.0;
    if (far > widest - away) continue;
    const double most = right_part * (away + far);  // from the obstacle on the preferred side
    for (std::size_t n = 0; n < neighbours.size(); ++n) {
      const Vec2 way{-static_cast<double>(neighbours[n].x), -static_cast<double>(neighbours[n].y)};
      const double left = cross(way, off) / (norm(way) * away);  // 1 if the obstacle is straight to the left
      if (std::abs(left) < ahead_part) continue;
      if ((side * left > 0.0 ? away : far) > most) wrong[i] = static_cast<std::uint8_t>(wrong[i] | (1U << n));
    }
  }
}

}  // namespace outrider
