#include "outrider/world/free_parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "inner_rings.hpp"
#include "outrider/world/blocks.hpp"
#include "outrider/world/clearance.hpp"
#include "outrider/world/occupancy.hpp"

namespace outrider {
namespace {

constexpr double half_diagonal = 0.5 * std::numbers::sqrt2;  // of a cell
constexpr std::array<Cell, 4> sides{Cell{1, 0}, Cell{0, 1}, Cell{-1, 0}, Cell{0, -1}};

Cell sum(Cell a, Cell b) { return {a.x + b.x, a.y + b.y}; }

/// Gives up free cells until no two of them meet at a corner only.
void give_up_pinches(Grid<std::uint8_t>& map) {
  const auto free = [&](Cell cell) { return map.contains(cell) && map[cell] == free_cell; };
  std::vector<Cell> corners;  // that are still to be looked at; each is the lowest corner of its cell
  const auto look_from = [&](Cell start) {
    corners.push_back(start);
    while (!corners.empty()) {
      const Cell c = corners.back();
      corners.pop_back();
      const bool right_up = free(c), left_up = free({c.x - 1, c.y}), right_down = free({c.x, c.y - 1}),
                 left_down = free({c.x - 1, c.y - 1});
      if (right_up == left_up || right_up == right_down || right_up != left_down) continue;
      const Cell given_up = right_up ? c : Cell{c.x - 1, c.y};
      map[given_up] = occupied_cell;
      for (const Cell corner :
           {given_up, sum(given_up, {1, 0}), sum(given_up, {0, 1}), sum(given_up, {1, 1})})
        corners.push_back(corner);
    }
  };
  for (int y = 1; y < map.frame.height; ++y) {
    for (int x = 1; x < map.frame.width; ++x) look_from({x, y});
  }
}

std::size_t flood(const Grid<std::uint8_t>& map, Grid<std::int32_t>& part, Cell start, std::int32_t label) {
  std::vector<Cell> open{start};
  part[start] = label;
  std::size_t cells = 0;
  while (!open.empty()) {
    const Cell cell = open.back();
    open.pop_back();
    ++cells;
    for (const Cell side : sides) {
      const Cell next = sum(cell, side);
      if (!map.contains(next) || map[next] != free_cell || part[next] >= 0) continue;
      part[next] = label;
      open.push_back(next);
    }
  }
  return cells;
}

/// The edges between a part and what is not in it, as steps from corner to corner, the part on the left.
class Tracer {
 public:
  Tracer(const Grid<std::int32_t>& part, std::int32_t label) : part_(part), label_(label) {
    seen_.resize(part.frame.size());
  }

  /// Returns the ring along the lower side of a cell; nothing if it is not an edge, or known.
  std::optional<LatticeRing> ring_below(Cell cell) {
    if (!in(cell) || in({cell.x, cell.y - 1}) || seen_[part_.frame.index(cell)]) return std::nullopt;
    LatticeRing ring;
    Cell corner = cell;
    std::size_t way = 0;  // index of the side to which it goes: right along a lower side
    do {
      const std::size_t next = turned(corner, way);
      if (next != way) ring.push_back(corner);
      way = next;
      if (way == 0) seen_[part_.frame.index(corner)] = true;
      corner = sum(corner, sides[way]);
    } while (!(corner == cell && turned(corner, way) == 0));
    if (way != 0) ring.push_back(corner);
    return ring;
  }

 private:
  [[nodiscard]] bool in(Cell cell) const { return part_.contains(cell) && part_[cell] == label_; }
  /// Returns the cell on the left of the step from a corner.
  static Cell left_of(Cell corner, std::size_t way) {
    constexpr std::array<Cell, 4> lefts{Cell{0, 0}, Cell{-1, 0}, Cell{-1, -1}, Cell{0, -1}};
    return sum(corner, lefts[way]);
  }
  /// Returns where to go on from a corner at which one came that way.
  [[nodiscard]] std::size_t turned(Cell corner, std::size_t way) const {
    for (const std::size_t next : {(way + 3) % 4, way, (way + 1) % 4}) {
      if (in(left_of(corner, next)) && !in(left_of(corner, (next + 3) % 4))) return next;
    }
    return way;
  }

  const Grid<std::int32_t>& part_;
  std::int32_t label_;
  std::vector<bool> seen_;  ///< the lower side of the cell is part of a ring
};

/// Returns twice the area; positive if it is counter-clockwise.
std::int64_t double_area(const LatticeRing& ring) {
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Cell a = ring[i], b = ring[(i + 1) % ring.size()];
    sum += std::int64_t{a.x} * b.y - std::int64_t{a.y} * b.x;
  }
  return sum;
}

}  // namespace

Grid<std::uint8_t> reach_of_disk(const Grid<std::uint8_t>& map, double radius_m) {
  const double radius = radius_m / map.frame.resolution_m;
  const double least = std::max(0.0, radius - half_diagonal + 0.5), most = radius + 2.0 * half_diagonal;
  const Grid<std::uint8_t> blocked = bordered(map, occupied_cell);
  const Grid<std::uint32_t> clearance = squared_clearance(blocked);
  Grid<std::uint8_t> stands(blocked.frame);
  for (std::size_t i = 0; i < stands.cells.size(); ++i)
    stands.cells[i] = blocked.cells[i] == free_cell && clearance.cells[i] >= least * least;
  const Grid<std::uint32_t> away = squared_clearance(stands);
  Grid<std::uint8_t> reached = map;
  for (std::size_t i = 0; i < reached.cells.size(); ++i) {
    const Cell cell = map.frame.cell(i);
    if (map.cells[i] == free_cell && !(away[sum(cell, {1, 1})] <= most * most))
      reached.cells[i] = occupied_cell;
  }
  return reached;
}

FreeParts free_parts(const Grid<std::uint8_t>& map) {
  Grid<std::uint8_t> apart = map;
  give_up_pinches(apart);
  Grid<std::int32_t> label(map.frame, -1);
  std::vector<std::size_t> cells;
  for (std::size_t i = 0; i < apart.cells.size(); ++i) {
    if (apart.cells[i] != free_cell || label.cells[i] >= 0) continue;
    cells.push_back(flood(apart, label, map.frame.cell(i), static_cast<std::int32_t>(cells.size())));
  }
  std::vector<std::size_t> order(cells.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, std::greater<>{}, [&](std::size_t part) { return cells[part]; });
  FreeParts parts{std::move(label), std::vector<std::size_t>(cells.size())};
  std::vector<std::int32_t> rank(cells.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    rank[order[i]] = static_cast<std::int32_t>(i);
    parts.cells[i] = cells[order[i]];
  }
  for (std::int32_t& part : parts.part.cells) part = part < 0 ? -1 : rank[static_cast<std::size_t>(part)];
  return parts;
}

FreeOutline outline_of(const FreeParts& parts, std::size_t part, double tolerance_m) {
  const GridFrame& frame = parts.part.frame;
  Tracer tracer(parts.part, static_cast<std::int32_t>(part));
  std::vector<LatticeRing> rings;
  for (std::size_t i = 0; i < frame.size(); ++i) {
    if (auto ring = tracer.ring_below(frame.cell(i))) rings.push_back(std::move(*ring));
  }
  FreeOutline outline;
  for (const LatticeRing& ring : cut_corners(rings, tolerance_m / frame.resolution_m)) {
    std::vector<Vec2> corners;
    for (const Cell cell : ring) corners.push_back(frame.corner(cell));
    if (double_area(ring) > 0) {
      outline.boundary = std::move(corners);
    } else {
      outline.holes.push_back(std::move(corners));
    }
  }
  return outline;
}

}  // namespace outrider
