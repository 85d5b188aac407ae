#include "cell_sweep.hpp"

#include <algorithm>
#include <cmath>

#include "outrider/core/units.hpp"

namespace outrider {
namespace {

int whole(double t) { return static_cast<int>(std::floor(t)); }

/// Calls visit(part) for each part of the piece while that returns true. Returns false if it once did not.
template <class Visit>
bool for_each_part(const PathPiece& piece, Visit visit) {
  if (piece.turn_rad == 0.0) return visit(MonotonePart{piece.from, piece.to, {}, 0.0, 1.0});
  const double radius = distance(piece.centre, piece.from);
  const double begin = heading_of(piece.from - piece.centre), end = begin + piece.turn_rad;
  const double sense = piece.turn_rad > 0.0 ? 1.0 : -1.0;
  double at = begin;
  Vec2 from = piece.from;
  while (true) {
    constexpr double quarter = 0.5 * pi;
    const double corner = quarter * (sense > 0.0 ? std::floor(at / quarter + 1e-12) + 1.0
                                                 : std::ceil(at / quarter - 1e-12) - 1.0);
    const bool last = sense * (end - corner) <= 0.0;
    const double next = last ? end : corner;
    const Vec2 to = last ? piece.to : piece.centre + radius * direction(corner);
    const double side = std::cos(0.5 * (at + next)) >= 0.0 ? 1.0 : -1.0;
    if (!visit(MonotonePart{from, to, piece.centre, radius, side})) return false;
    if (last) return true;
    at = next;
    from = to;
  }
}

/// A part that was moved, from its lower end to its upper one.
struct PlacedPart {
  Vec2 low, high;
  Vec2 centre;
  double radius = 0.0, side = 1.0;

  PlacedPart(const MonotonePart& part, Vec2 by)
      : low(part.from + by),
        high(part.to + by),
        centre(part.centre + by),
        radius(part.radius),
        side(part.side) {
    if (low.y > high.y) std::swap(low, high);
  }
  [[nodiscard]] double x_at(double y) const {
    if (y <= low.y) return low.x;
    if (y >= high.y) return high.x;
    if (radius == 0.0) return low.x + (y - low.y) * (high.x - low.x) / (high.y - low.y);
    const double up = y - centre.y;
    const double x = centre.x + side * std::sqrt(std::max(0.0, radius * radius - up * up));
    return std::clamp(x, std::min(low.x, high.x), std::max(low.x, high.x));
  }
};

/// Calls visit(row, least x, largest x) for each row of cells that the part touches, while that returns true.
/// Returns false if it once did not.
template <class Visit>
bool for_each_row(const PlacedPart& part, Visit visit) {
  const int last = whole(part.high.y + cell_touch);
  double enter = part.low.x;
  for (int row = whole(part.low.y - cell_touch); row <= last; ++row) {
    const double leave = part.x_at(row + 1.0);
    const auto [left, right] = std::minmax(enter, leave);
    if (!visit(row, left, right)) return false;
    enter = leave;
  }
  return true;
}

}  // namespace

void add_monotone_parts(const PathPiece& piece, std::vector<MonotonePart>& parts) {
  for_each_part(piece, [&](const MonotonePart& part) {
    parts.push_back(part);
    return true;
  });
}

void widen_rows(const MonotonePart& part, Vec2 by, int first_row, std::span<Interval> rows) {
  for_each_row(PlacedPart(part, by), [&](int row, double left, double right) {
    Interval& range = rows[static_cast<std::size_t>(row - first_row)];
    range = {std::min(range.low, left), std::max(range.high, right)};
    return true;
  });
}

bool is_inside(const GridMap& ground, const MonotonePart& part, Vec2 by) {
  const Vec2 a = part.from + by, b = part.to + by;
  return std::min(a.x, b.x) > cell_touch && std::min(a.y, b.y) > cell_touch &&
         std::max(a.x, b.x) < ground.frame.width - cell_touch &&
         std::max(a.y, b.y) < ground.frame.height - cell_touch;
}

bool clear_of_cells(const GridMap& ground, const MonotonePart& part, Vec2 by) {
  if (!is_inside(ground, part, by)) return false;
  return for_each_row(PlacedPart(part, by), [&](int row, double left, double right) {
    const std::uint32_t begin_of_row = ground.index({0, row});
    const int last = whole(right + cell_touch);
    for (int column = whole(left - cell_touch); column <= last; ++column) {
      const auto at = begin_of_row + static_cast<std::uint32_t>(column);
      if ((ground.marks[at] & GridMap::blocked_bit) != 0) return false;
    }
    return true;
  });
}

bool clear_of_cells(const GridMap& ground, const PathPiece& piece) {
  return for_each_part(piece, [&](const MonotonePart& part) { return clear_of_cells(ground, part); });
}

void add_touched_cells(const PathPiece& piece, std::vector<Cell>& cells) {
  for_each_part(piece, [&](const MonotonePart& part) {
    return for_each_row(PlacedPart(part, {}), [&](int row, double left, double right) {
      const int last = whole(right + cell_touch);
      for (int column = whole(left - cell_touch); column <= last; ++column) cells.push_back({column, row});
      return true;
    });
  });
}

}  // namespace outrider
