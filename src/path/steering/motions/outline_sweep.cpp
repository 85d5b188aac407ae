#include "outline_sweep.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "outrider/core/units.hpp"
#include "outrider/path/pieces.hpp"

namespace outrider {
namespace {

constexpr double slack = 1e-12;  // of a part of a side, and of an angle
constexpr double infinite = std::numeric_limits<double>::infinity();

std::array<Vec2, 4> corners_of(const Box2& box) {
  return {box.low, Vec2{box.high.x, box.low.y}, box.high, Vec2{box.low.x, box.high.y}};
}

/// Returns true if a convex polygon and a box have a common point.
bool overlap(const std::vector<Vec2>& polygon, const Box2& box) {
  Box2 around;
  for (const Vec2 corner : polygon) around.include(corner);
  if (!around.overlaps(box)) return false;
  const auto corners = corners_of(box);
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i], side = polygon[(i + 1) % polygon.size()] - a;
    if (std::ranges::all_of(corners, [&](Vec2 p) { return cross(side, p - a) < 0.0; })) return false;
  }
  return true;
}

/// Returns true if p, turned about the origin, comes to the segment.
bool comes_to(Vec2 p, double turn_rad, Vec2 a, Vec2 b) {
  const Vec2 along = b - a;
  const double length2 = squared_norm(along), half = dot(a, along);
  const double inside = half * half - length2 * (squared_norm(a) - squared_norm(p));
  if (inside < 0.0 || length2 == 0.0) return false;
  const double root = std::sqrt(inside);
  const auto passes = [&](double part) {
    if (part < -slack || part > 1.0 + slack) return false;
    const Vec2 q = a + part * along;
    const double ahead = std::copysign(1.0, turn_rad) * std::atan2(cross(p, q), dot(p, q));
    return (ahead < -slack ? ahead + 2.0 * pi : ahead) <= std::abs(turn_rad) + slack;
  };
  return passes((-half - root) / length2) || passes((root - half) / length2);
}

/// A robot on an arc, seen from the centre, about which it turns.
class ArcSweep {
 public:
  ArcSweep(const OutlineSweep& sweep, Vec2 by)
      : turn_rad_(sweep.piece.turn_rad), centre_(sweep.piece.centre + by) {
    for (const Vec2 corner : sweep.outline)
      begin_.push_back(sweep.piece.from - sweep.piece.centre + rotated(sweep.heading_rad, corner));
  }
  [[nodiscard]] bool touches(Cell cell) const {
    const Vec2 low = Vec2{double(cell.x), double(cell.y)} - centre_;
    const Box2 box = Box2{low, low + Vec2{1.0, 1.0}}.grown(cell_touch);
    if (overlap(begin_, box)) return true;
    const auto corners = corners_of(box);
    for (std::size_t i = 0; i < begin_.size(); ++i) {
      const Vec2 a = begin_[i], b = begin_[(i + 1) % begin_.size()];
      for (std::size_t k = 0; k < corners.size(); ++k) {
        if (comes_to(a, turn_rad_, corners[k], corners[(k + 1) % 4])) return true;
        if (comes_to(corners[k], -turn_rad_, a, b)) return true;
      }
    }
    return false;
  }

 private:
  double turn_rad_;
  Vec2 centre_;
  std::vector<Vec2> begin_;  // corners of the robot, from the centre
};

/// Calls visit(cell) for each cell that the robot may touch, while that returns true; it touches all of them
/// on a leg. Returns false if it once did not.
template <class Visit>
bool for_each_near_cell(std::span<const MonotonePart> border, Vec2 by, Visit visit) {
  double low_y = infinite, high_y = -infinite;
  for (const MonotonePart& part : border) {
    low_y = std::min({low_y, part.from.y, part.to.y});
    high_y = std::max({high_y, part.from.y, part.to.y});
  }
  const auto whole = [](double t) { return static_cast<int>(std::floor(t)); };
  const int first = whole(low_y + by.y - 2.0 * cell_touch), last = whole(high_y + by.y + 2.0 * cell_touch);
  thread_local std::vector<Interval> rows;  // kept, as this is called for every motion of a search
  rows.assign(static_cast<std::size_t>(last - first) + 1, {infinite, -infinite});
  for (const MonotonePart& part : border) widen_rows(part, by, first, rows);
  for (int row = first; row <= last; ++row) {
    const Interval& range = rows[static_cast<std::size_t>(row - first)];
    if (range.low > range.high) continue;
    const int end = whole(range.high + cell_touch);
    for (int column = whole(range.low - cell_touch); column <= end; ++column) {
      if (!visit(Cell{column, row})) return false;
    }
  }
  return true;
}

}  // namespace

void add_border_parts(const OutlineSweep& sweep, std::vector<MonotonePart>& parts) {
  const auto& [outline, piece, heading_rad] = sweep;
  std::vector<PathPiece> ways;
  ways.reserve(outline.size());
  for (const Vec2 corner : outline) ways.push_back(carried(piece, heading_rad, corner));
  for (std::size_t i = 0; i < ways.size(); ++i) {
    add_monotone_parts(ways[i], parts);
    if (ways.size() == 1) continue;
    const PathPiece& next = ways[(i + 1) % ways.size()];
    parts.push_back({ways[i].from, next.from, {}, 0.0, 1.0});
    parts.push_back({ways[i].to, next.to, {}, 0.0, 1.0});
    if (piece.turn_rad == 0.0) continue;
    const Vec2 side = next.from - ways[i].from, arm = piece.centre - ways[i].from;
    const double part = dot(arm, side) / squared_norm(side);
    if (part <= 0.0 || part >= 1.0) continue;
    PathPiece nearest = piece;
    nearest.from = ways[i].from + part * side;
    nearest.to = ways[i].to + part * (next.to - ways[i].to);
    add_monotone_parts(nearest, parts);
  }
}

bool clear_of_cells(const GridMap& ground, const OutlineSweep& sweep, std::span<const MonotonePart> border,
                    Vec2 by) {
  if (sweep.outline.size() == 1)
    return std::ranges::all_of(border, [&](const MonotonePart& p) { return clear_of_cells(ground, p, by); });
  if (!std::ranges::all_of(border, [&](const MonotonePart& p) { return is_inside(ground, p, by); }))
    return false;
  std::optional<ArcSweep> arc;
  return for_each_near_cell(border, by, [&](Cell cell) {
    if ((ground.marks[ground.index(cell)] & GridMap::blocked_bit) == 0) return true;
    if (sweep.piece.turn_rad == 0.0) return false;
    if (!arc) arc.emplace(sweep, by);
    return !arc->touches(cell);
  });
}

void add_touched_cells(const OutlineSweep& sweep, std::vector<Cell>& cells) {
  if (sweep.outline.size() == 1) {
    add_touched_cells(sweep.piece, cells);
    return;
  }
  std::vector<MonotonePart> border;
  add_border_parts(sweep, border);
  const ArcSweep arc(sweep, {});
  for_each_near_cell(border, {}, [&](Cell cell) {
    if (sweep.piece.turn_rad == 0.0 || arc.touches(cell)) cells.push_back(cell);
    return true;
  });
}

}  // namespace outrider
