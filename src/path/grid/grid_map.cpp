#include "outrider/path/grid/grid_map.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "outrider/path/grid/from_occupancy.hpp"

namespace outrider {
namespace {

/// Returns the legal moves from a vertex. `free(dx, dy)` returns true if the cell at that offset from v is
/// free.
template <class Free>
std::uint8_t moves_between_centres(Free free) {
  unsigned mask = 0;
  for (unsigned i = 0; i < 8; ++i) {
    const Cell d = grid_moves[i];
    if (free(d.x, d.y) && free(d.x, 0) && free(0, d.y)) mask |= 1U << i;
  }
  return free(0, 0) ? static_cast<std::uint8_t>(mask) : std::uint8_t{0};
}

template <class Free>
std::uint8_t moves_between_corners(Free free) {
  const bool ne = free(0, 0), nw = free(-1, 0), sw = free(-1, -1), se = free(0, -1);
  const std::array<bool, 8> legal = {ne || se, ne || nw, nw || sw, sw || se, ne, nw, sw, se};
  unsigned mask = 0;
  for (unsigned i = 0; i < 8; ++i) mask |= legal[i] ? 1U << i : 0U;
  return static_cast<std::uint8_t>(mask);
}

template <class Free>
bool pinched(Free free) {
  return free(0, 0) == free(-1, -1) && free(-1, 0) == free(0, -1) && free(0, 0) != free(-1, 0);
}

/// Sets the moves and marks of a vertex from the cells around it.
void set_vertex(GridMap& ground, Cell v) {
  const std::uint32_t at = ground.index(v);
  const auto free = [&](int dx, int dy) {
    return (ground.marks[ground.index({v.x + dx, v.y + dy})] & GridMap::blocked_bit) == 0;
  };
  const bool corners = ground.model == GridModel::corners;
  ground.moves[at] = corners ? moves_between_corners(free) : moves_between_centres(free);
  unsigned mark = ground.marks[at] & GridMap::blocked_bit;
  if (corners ? ground.moves[at] != 0 : free(0, 0)) mark |= GridMap::place_bit;
  if (corners && pinched(free)) mark |= GridMap::pinch_bit;
  ground.marks[at] = static_cast<std::uint8_t>(mark);
}

/// Sets the vertices from `low` to `high` that are in the grid.
void set_vertices(GridMap& ground, Cell low, Cell high, const std::stop_token& stop = {}) {
  const int more = ground.model == GridModel::corners ? 1 : 0;
  const Cell last{std::min(high.x, ground.frame.width - 1 + more),
                  std::min(high.y, ground.frame.height - 1 + more)};
  for (int y = std::max(low.y, 0); y <= last.y && !stop.stop_requested(); ++y) {
    for (int x = std::max(low.x, 0); x <= last.x; ++x) set_vertex(ground, {x, y});
  }
}

Status check_change(const GridFrame& frame, const CellChange& change) {
  const auto [x, y] = change.low;
  if (change.width < 1 || change.height < 1) {
    return bad_input(fmt::format("a change of {} x {} cells is not valid; it has at least one cell",
                                 change.width, change.height));
  }
  if (frame.contains(change.low) && change.width <= frame.width - x && change.height <= frame.height - y) {
    return {};
  }
  return bad_input(
      fmt::format("the change of {} x {} cells at cell ({}, {}) leaves the grid; it has x from 0 "
                  "to {} and y from 0 to {}",
                  change.width, change.height, x, y, frame.width - 1, frame.height - 1));
}

}  // namespace

std::string_view to_string(GridModel model) { return model == GridModel::cells ? "cells" : "corners"; }

Status check_frame(const GridFrame& frame) {
  if (!finite(frame.origin) || !std::isfinite(frame.resolution_m) || !(frame.resolution_m > 0.0)) {
    return bad_input(
        fmt::format("a grid at ({}, {}) with cells of {} m is not valid; give finite numbers and "
                    "a resolution above 0",
                    frame.origin.x, frame.origin.y, frame.resolution_m));
  }
  if (frame.width < 1 || frame.height < 1 || frame.width > most_grid_side || frame.height > most_grid_side ||
      frame.size() > most_grid_cells) {
    return bad_input(fmt::format("a grid of {} x {} cells is not valid; expected 1 to {} cells in all",
                                 frame.width, frame.height, most_grid_cells));
  }
  return {};
}

Outcome<GridMap> grid_map_of(const Grid<std::uint8_t>& blocked, GridModel model,
                             const std::stop_token& stop) {
  if (auto good = check_frame(blocked.frame); !good) return pass_on(good);
  if (blocked.cells.size() != blocked.frame.size()) {
    return bad_input(fmt::format("a grid of {} x {} cells came with {} values; give one for each cell",
                                 blocked.frame.width, blocked.frame.height, blocked.cells.size()));
  }
  GridMap ground;
  ground.frame = blocked.frame;
  ground.model = model;
  ground.stride = static_cast<std::uint32_t>(blocked.frame.width) + 2;
  const std::size_t size = std::size_t{ground.stride} * (static_cast<std::size_t>(blocked.frame.height) + 2);
  ground.marks.assign(size, GridMap::blocked_bit);
  ground.moves.assign(size, 0);
  for (int y = 0; y < blocked.frame.height && !stop.stop_requested(); ++y) {
    for (int x = 0; x < blocked.frame.width; ++x) {
      if (blocked[{x, y}] == 0) ground.marks[ground.index({x, y})] = 0;
    }
  }
  set_vertices(ground, {0, 0}, {blocked.frame.width, blocked.frame.height}, stop);
  if (stop.stop_requested()) return fault(FaultCode::cancelled, "it was cancelled while it made the grid");
  return ground;
}

Outcome<GridMap> GridMap::of(const Grid<std::uint8_t>& blocked, GridModel model) {
  return grid_map_of(blocked, model, {});
}

Outcome<GridMap> GridMap::with(const std::vector<CellChange>& changes) const {
  for (const CellChange& change : changes) {
    if (auto good = check_change(frame, change); !good) return pass_on(good);
  }
  GridMap ground = *this;
  for (const CellChange& change : changes) {
    for (int y = change.low.y; y < change.low.y + change.height; ++y) {
      const auto row = ground.marks.begin() + ground.index({change.low.x, y});
      std::fill(row, row + change.width, change.blocked ? blocked_bit : std::uint8_t{0});
    }
  }
  for (const CellChange& change : changes) {
    const auto [x, y] = change.low;
    set_vertices(ground, {x - 1, y - 1}, {x + change.width, y + change.height});
  }
  return ground;
}

std::optional<Cell> GridMap::vertex_at(Vec2 p) const {
  constexpr double slack = 1e-6;  // in cells: a point computed to lie on the edge is within
  const double x = (p.x - frame.origin.x) / frame.resolution_m;
  const double y = (p.y - frame.origin.y) / frame.resolution_m;
  const bool within = x >= -slack && y >= -slack && x <= frame.width + slack && y <= frame.height + slack;
  if (!within) return std::nullopt;
  const bool corners = model == GridModel::corners;
  const auto nearest = [&](double t, int cells) {  // what is below 0 by no more than the slack becomes 0
    return std::clamp(static_cast<int>(corners ? t + 0.5 : t), 0, corners ? cells : cells - 1);
  };
  return Cell{nearest(x, frame.width), nearest(y, frame.height)};
}

std::optional<std::vector<Cell>> cells_changed(const GridMap& before, const GridMap& now, std::size_t most) {
  if (before.frame != now.frame || before.model != now.model) return std::nullopt;
  std::vector<Cell> changed;
  const auto width = static_cast<std::size_t>(now.frame.width);
  for (int y = 0; y < now.frame.height; ++y) {
    const std::uint8_t* const was = before.marks.data() + before.index({0, y});
    const std::uint8_t* const is = now.marks.data() + now.index({0, y});
    if (std::memcmp(was, is, width) == 0) continue;
    for (std::size_t x = 0; x < width; ++x) {
      if (((was[x] ^ is[x]) & GridMap::blocked_bit) != 0) changed.push_back({static_cast<int>(x), y});
    }
    if (changed.size() > most) return std::nullopt;
  }
  return changed;
}

}  // namespace outrider
