#include "outrider/path/grid_ground.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace outrider {
namespace {

/// The legal moves from a vertex: `free(dx, dy)` says whether the cell at that offset from v is free.
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

}  // namespace

std::string_view to_string(GridModel model) { return model == GridModel::cells ? "cells" : "corners"; }

Status check_frame(const GridFrame& frame) {
  if (!std::isfinite(frame.origin.x) || !std::isfinite(frame.origin.y) ||
      !std::isfinite(frame.resolution_m) || !(frame.resolution_m > 0.0)) {
    return bad_input(
        fmt::format("a grid at ({}, {}) with cells of {} m is no good; give finite numbers and "
                    "a resolution above 0",
                    frame.origin.x, frame.origin.y, frame.resolution_m));
  }
  if (frame.width < 1 || frame.height < 1 || frame.width > most_grid_side || frame.height > most_grid_side ||
      frame.size() > most_grid_cells) {
    return bad_input(fmt::format("a grid of {} x {} cells is no good; it takes 1 to {} cells in all",
                                 frame.width, frame.height, most_grid_cells));
  }
  return {};
}

Outcome<GridGround> GridGround::of(const Grid<std::uint8_t>& blocked, GridModel model) {
  if (auto good = check_frame(blocked.frame); !good) return pass_on(good);
  if (blocked.cells.size() != blocked.frame.size()) {
    return bad_input(fmt::format("a grid of {} x {} cells came with {} values; give one for each cell",
                                 blocked.frame.width, blocked.frame.height, blocked.cells.size()));
  }
  GridGround ground;
  ground.frame = blocked.frame;
  ground.model = model;
  ground.stride = static_cast<std::uint32_t>(blocked.frame.width) + 2;
  const std::size_t size = std::size_t{ground.stride} * (static_cast<std::size_t>(blocked.frame.height) + 2);
  ground.marks.assign(size, blocked_bit);
  ground.moves.assign(size, 0);
  for (int y = 0; y < blocked.frame.height; ++y) {
    for (int x = 0; x < blocked.frame.width; ++x) {
      if (blocked[{x, y}] == 0) ground.marks[ground.index({x, y})] = 0;
    }
  }

  const int more = model == GridModel::corners ? 1 : 0;
  for (int y = 0; y < blocked.frame.height + more; ++y) {
    for (int x = 0; x < blocked.frame.width + more; ++x) {
      const auto free = [&](int dx, int dy) {
        return (ground.marks[ground.index({x + dx, y + dy})] & blocked_bit) == 0;
      };
      const std::uint32_t v = ground.index({x, y});
      const bool corners = model == GridModel::corners;
      ground.moves[v] = corners ? moves_between_corners(free) : moves_between_centres(free);
      if (corners ? ground.moves[v] != 0 : free(0, 0)) ground.marks[v] |= place_bit;
      if (corners && pinched(free)) ground.marks[v] |= pinch_bit;
    }
  }
  return ground;
}

std::optional<Cell> GridGround::vertex_at(Vec2 p) const {
  constexpr double slack = 1e-6;  // in cells: a point computed to lie on the edge is within
  const double x = (p.x - frame.origin.x) / frame.resolution_m;
  const double y = (p.y - frame.origin.y) / frame.resolution_m;
  const bool within = x >= -slack && y >= -slack && x <= frame.width + slack && y <= frame.height + slack;
  if (!within) return std::nullopt;
  const bool corners = model == GridModel::corners;
  const auto nearest = [&](double t, int cells) {
    return std::clamp(static_cast<int>(std::floor(corners ? t + 0.5 : t)), 0, corners ? cells : cells - 1);
  };
  return Cell{nearest(x, frame.width), nearest(y, frame.height)};
}

}  // namespace outrider
