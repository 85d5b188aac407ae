#include "cell_sweep.hpp"

#include <algorithm>
#include <cmath>

#include "outrider/core/units.hpp"

namespace outrider {
namespace {

constexpr double touch = 1e-9;

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

/// Calls visit(row, first column, last column) for the cells of each row that the part touches, while that
/// returns true. Returns false if it once did not.
template <class Visit>
bool for_each_row(const MonotonePart& part, Vec2 by, Visit visit) {
  Vec2 low = part.from + by, high = part.to + by;
  if (low.y > high.y) std::swap(low, high);
  const auto [least_x, most_x] = std::minmax(low.x, high.x);
  const Vec2 centre = part.centre + by;
  const auto x_at = [&, left = least_x, right = most_x](double y) {
    if (y <= low.y) return low.x;
    if (y >= high.y) return high.x;
    if (part.radius == 0.0) return low.x + (y - low.y) * (high.x - low.x) / (high.y - low.y);
    const double up = y - centre.y;
    const double x = centre.x + part.side * std::sqrt(std::max(0.0, part.radius * part.radius - up * up));
    return std::clamp(x, left, right);
  };
  const auto whole = [](double t) { return static_cast<int>(std::floor(t)); };
  const int last = whole(high.y + touch);
  double enter = low.x;
  for (int row = whole(low.y - touch); row <= last; ++row) {
    const double leave = x_at(row + 1.0);
    const auto [left, right] = std::minmax(enter, leave);
    if (!visit(row, whole(left - touch), whole(right + touch))) return false;
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

bool clear_of_cells(const GridMap& ground, const MonotonePart& part, Vec2 by) {
  const Vec2 a = part.from + by, b = part.to + by;
  const bool inside = std::min(a.x, b.x) > touch && std::min(a.y, b.y) > touch &&
                      std::max(a.x, b.x) < ground.frame.width - touch &&
                      std::max(a.y, b.y) < ground.frame.height - touch;
  if (!inside) return false;
  return for_each_row(part, by, [&](int row, int first, int last) {
    const std::uint32_t begin_of_row = ground.index({0, row});
    for (int column = first; column <= last; ++column) {
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
    return for_each_row(part, {}, [&](int row, int first, int last) {
      for (int column = first; column <= last; ++column) cells.push_back({column, row});
      return true;
    });
  });
}

}  // namespace outrider
