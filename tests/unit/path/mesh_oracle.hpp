// Laws that any mesh keeps, whoever made it, told from the cells of its grid.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "outrider/path/mesh/mesh.hpp"
#include "support/grid_oracle.hpp"

namespace outrider::mesh_oracle {

using oracle::Blocked;
constexpr std::uint32_t none = NavigationMesh::none;

inline std::vector<Cell> corners_of(const NavigationMesh& mesh, std::uint32_t polygon) {
  std::vector<Cell> corners;
  for (std::uint32_t s = mesh.first[polygon]; s < mesh.first[polygon + 1]; ++s)
    corners.push_back(mesh.sides[s].at);
  return corners;
}

inline std::int64_t turned(Cell a, Cell b, Cell c) {
  return std::int64_t{b.x - a.x} * (c.y - a.y) - std::int64_t{b.y - a.y} * (c.x - a.x);
}

inline Cell end_of(const NavigationMesh& mesh, std::uint32_t polygon, std::uint32_t s) {
  return mesh.sides[s + 1 == mesh.first[polygon + 1] ? mesh.first[polygon] : s + 1].at;
}

/// A point in units of 1 / scale of a cell, in a polygon or on its border.
inline bool holds(const std::vector<Cell>& polygon, Cell point, int scale) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Cell a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    if (turned({scale * a.x, scale * a.y}, {scale * b.x, scale * b.y}, point) < 0) return false;
  }
  return true;
}

/// The polygons that are not gone.
inline std::vector<std::uint32_t> polygons_of(const NavigationMesh& mesh) {
  std::vector<std::uint32_t> polygons;
  for (std::uint32_t p = 0; p < mesh.polygons(); ++p) {
    if (!mesh.is_gone(p)) polygons.push_back(p);
  }
  return polygons;
}

/// Polygons are convex and cover the free cells once.
inline void expect_cover(const Blocked& grid, const NavigationMesh& mesh) {
  std::int64_t twice_area = 0;
  for (const std::uint32_t p : polygons_of(mesh)) {
    const auto corners = corners_of(mesh, p);
    ASSERT_GE(corners.size(), 3U);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Cell a = corners[i], b = corners[(i + 1) % corners.size()], c = corners[(i + 2) % corners.size()];
      ASSERT_GE(turned(a, b, c), 0);
      twice_area += std::int64_t{a.x} * b.y - std::int64_t{a.y} * b.x;
    }
  }
  ASSERT_EQ(twice_area, 2 * std::count(grid.cells.begin(), grid.cells.end(), 0));
  // As much area as there are free cells, none of it on a blocked cell: so nothing is covered twice
  // unless something is left out.
  constexpr int fine = 1000003;  // a prime: the points looked at lie on no side shorter than 400 cells
  for (int y = 0; y < grid.frame.height; ++y) {
    for (int x = 0; x < grid.frame.width; ++x) {
      const bool is_free = !oracle::blocked(grid, x, y);
      int around = 0, inside = 0;
      for (const std::uint32_t p : polygons_of(mesh)) {
        const auto corners = corners_of(mesh, p);
        around += holds(corners, {2 * x + 1, 2 * y + 1}, 2) ? 1 : 0;
        inside += holds(corners, {fine * x + 271828, fine * y + 442158}, fine) ? 1 : 0;
      }
      ASSERT_EQ(inside, is_free ? 1 : 0);
      ASSERT_EQ(around > 0, is_free);
      const std::uint32_t known = mesh.polygon_of[grid.frame.index({x, y})];
      ASSERT_EQ(known != none, is_free);
      if (known != none) {
        ASSERT_TRUE(holds(corners_of(mesh, known), {2 * x + 1, 2 * y + 1}, 2));
      }
    }
  }
}

/// Sides fit together, and the others are borders.
inline void expect_fit(const Blocked& grid, const NavigationMesh& mesh) {
  for (const std::uint32_t p : polygons_of(mesh)) {
    for (std::uint32_t s = mesh.first[p]; s < mesh.first[p + 1]; ++s) {
      const NavigationMesh::Side& side = mesh.sides[s];
      const Cell a = side.at, b = end_of(mesh, p, s);
      if (side.behind != none) {
        const NavigationMesh::Side& behind = mesh.sides[side.behind];
        ASSERT_EQ(behind.polygon, p);
        ASSERT_EQ(behind.behind, s);
        ASSERT_EQ(behind.at, b);
        ASSERT_EQ(end_of(mesh, side.polygon, side.behind), a);
        ASSERT_EQ(behind.block, side.block);
        ASSERT_TRUE(oracle::legal(grid, GridModel::corners, a, b));
        continue;
      }
      ASSERT_EQ(side.polygon, none);
      ASSERT_TRUE(a.x == b.x || a.y == b.y);
      for (int i = 0; i < std::abs(b.x - a.x) + std::abs(b.y - a.y); ++i) {  // the cells to its right
        const Cell beyond = a.y == b.y ? (b.x > a.x ? Cell{a.x + i, a.y - 1} : Cell{a.x - 1 - i, a.y})
                                       : (b.y > a.y ? Cell{a.x, a.y + i} : Cell{a.x - 1, a.y - 1 - i});
        ASSERT_TRUE(oracle::blocked(grid, beyond.x, beyond.y));
      }
    }
  }
}

/// Turns are the corners of one blocked cell.
inline void expect_turns(const Blocked& grid, const NavigationMesh& mesh) {
  std::set<std::pair<int, int>> turns;
  for (std::size_t t = 0; t < mesh.turns.size(); ++t) {
    const auto& [v, begin, count] = mesh.turns[t];
    if (count == 0) continue;
    ASSERT_TRUE(turns.insert({v.x, v.y}).second);
    std::set<std::uint32_t> around;
    for (std::uint32_t i = begin; i < begin + count; ++i) {
      const NavigationMesh::Wedge& wedge = mesh.around[i];
      ASSERT_EQ(mesh.sides[wedge.side].at, v);
      ASSERT_EQ(mesh.sides[wedge.side].turn, t);
      ASSERT_GE(wedge.side, mesh.first[wedge.polygon]);
      ASSERT_LT(wedge.side, mesh.first[wedge.polygon + 1]);
      const unsigned q = mesh.sides[wedge.side].blocked;
      ASSERT_TRUE(oracle::blocked(grid, v.x - ((q & 1U) != 0 ? 0 : 1), v.y - ((q & 2U) != 0 ? 0 : 1)));
      ASSERT_TRUE(around.insert(wedge.polygon).second);
    }
    for (const std::uint32_t p : polygons_of(mesh)) {
      ASSERT_EQ(around.count(p) != 0, holds(corners_of(mesh, p), v, 1));
    }
  }
  for (int y = 0; y <= grid.frame.height; ++y) {
    for (int x = 0; x <= grid.frame.width; ++x) {
      const int count = oracle::blocked(grid, x, y) + oracle::blocked(grid, x - 1, y) +
                        oracle::blocked(grid, x, y - 1) + oracle::blocked(grid, x - 1, y - 1);
      ASSERT_EQ(turns.count({x, y}) != 0, count == 1);
    }
  }
}

/// polygons_at() finds those that hold a corner.
inline void expect_polygons_at(const Blocked& grid, const NavigationMesh& mesh) {
  for (int y = 0; y <= grid.frame.height; ++y) {
    for (int x = 0; x <= grid.frame.width; ++x) {
      std::vector<std::uint32_t> found;
      for (const Cell c : {Cell{x, y}, Cell{x - 1, y}, Cell{x, y - 1}, Cell{x - 1, y - 1}}) {
        if (!oracle::blocked(grid, c.x, c.y)) mesh.polygons_at({x, y}, c, grid.frame, found);
      }
      std::sort(found.begin(), found.end());
      std::vector<std::uint32_t> expected;
      for (const std::uint32_t p : polygons_of(mesh)) {
        if (holds(corners_of(mesh, p), {x, y}, 1)) expected.push_back(p);
      }
      ASSERT_EQ(found, expected);
    }
  }
}

/// Blocks crossed by any way from `here` to `to` that enters no polygon twice.
inline void cross(const NavigationMesh& mesh, std::uint32_t here, std::uint32_t to,
                  std::vector<bool>& entered, std::vector<std::uint32_t>& way,
                  std::set<std::uint32_t>& crossed) {
  if (here == to) crossed.insert(way.begin(), way.end());
  if (here == to) return;
  entered[here] = true;
  for (std::uint32_t s = mesh.first[here]; s < mesh.first[here + 1]; ++s) {
    const NavigationMesh::Side& side = mesh.sides[s];
    if (side.polygon == none || entered[side.polygon]) continue;
    way.push_back(side.block);
    cross(mesh, side.polygon, to, entered, way, crossed);
    way.pop_back();
  }
  entered[here] = false;
}

/// Blocks between each two polygons are those on ways without detours; where the mesh has changed, also
/// others of the core.
inline void expect_blocks(const NavigationMesh& mesh) {
  const std::set<std::uint32_t> core(mesh.core.begin(), mesh.core.end());
  ASSERT_EQ(core.size(), mesh.core.size());
  for (std::uint32_t block = 0; block < mesh.top.size(); ++block)
    ASSERT_EQ(mesh.top[block] == none, core.count(block) != 0);
  const auto in_core = [&](std::uint32_t p) { return mesh.up[p] != none && core.count(mesh.up[p]) != 0; };
  for (const std::uint32_t a : polygons_of(mesh)) {
    for (const std::uint32_t b : polygons_of(mesh)) {
      std::set<std::uint32_t> expected, found;
      std::vector<bool> entered(mesh.polygons(), false);
      std::vector<std::uint32_t> way;
      cross(mesh, a, b, entered, way, expected);
      std::uint32_t x = a, y = b;
      for (bool on = true; on && x != y;) {
        std::uint32_t& lower = mesh.order[x] >= mesh.order[y] ? x : y;
        on = mesh.up[lower] != none && !in_core(lower);
        if (!on) break;
        found.insert(mesh.up[lower]);
        lower = mesh.top[mesh.up[lower]];
      }
      const bool crosses_core = x != y;
      for (std::uint32_t* p : {&x, &y}) {
        while (crosses_core && mesh.up[*p] != none && !in_core(*p)) {
          found.insert(mesh.up[*p]);
          *p = mesh.top[mesh.up[*p]];
        }
      }
      const bool joined = x == y || (in_core(x) && in_core(y));
      ASSERT_TRUE(!core.empty() || joined == (a == b || !expected.empty()));
      ASSERT_TRUE(joined || expected.empty());
      if (!joined) continue;
      if (crosses_core) found.insert(core.begin(), core.end());
      ASSERT_TRUE(!core.empty() || found == expected);
      ASSERT_TRUE(std::includes(found.begin(), found.end(), expected.begin(), expected.end()));
      for (const std::uint32_t block : found)
        ASSERT_TRUE(core.count(block) != 0 || expected.count(block) != 0 || crosses_core);
    }
  }
}

}  // namespace outrider::mesh_oracle
