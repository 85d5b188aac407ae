#include "outrider/path/mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "support/grid_oracle.hpp"
#include "support/random_grid.hpp"

namespace outrider {
namespace {

using oracle::Blocked;
using Side = NavigationMesh::Side;
constexpr std::uint32_t none = NavigationMesh::none;

std::vector<Cell> corners_of(const NavigationMesh& mesh, std::uint32_t polygon) {
  std::vector<Cell> corners;
  for (std::uint32_t s = mesh.first[polygon]; s < mesh.first[polygon + 1]; ++s)
    corners.push_back(mesh.sides[s].at);
  return corners;
}
std::int64_t turned(Cell a, Cell b, Cell c) {
  return std::int64_t{b.x - a.x} * (c.y - a.y) - std::int64_t{b.y - a.y} * (c.x - a.x);
}
Cell end_of(const NavigationMesh& mesh, std::uint32_t polygon, std::uint32_t s) {
  return mesh.sides[s + 1 == mesh.first[polygon + 1] ? mesh.first[polygon] : s + 1].at;
}
bool holds(const std::vector<Cell>& polygon, Cell twice, int scale) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Cell a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    if (turned({scale * a.x, scale * a.y}, {scale * b.x, scale * b.y}, twice) < 0) return false;
  }
  return true;
}

class MeshOfRandomGrids : public testing::Test {
 protected:
  template <class Check>
  void each(int count, int most_side, Check check) {
    Rng rng = Rng(5).child("mesh");
    for (int i = 0; i < count && !HasFatalFailure(); ++i) {
      const Blocked grid = random_grid(rng, most_side);
      const auto ground = GridGround::of(grid, GridModel::corners);
      ASSERT_TRUE(ground.has_value());
      SCOPED_TRACE(i);
      check(grid, navigation_mesh(*ground));
    }
  }
};

TEST_F(MeshOfRandomGrids, PolygonsAreConvexAndCoverTheFreeCellsOnce) {
  each(600, 14, [](const Blocked& grid, const NavigationMesh& mesh) {
    std::int64_t twice_area = 0;
    for (std::uint32_t p = 0; p < mesh.polygons(); ++p) {
      const auto corners = corners_of(mesh, p);
      ASSERT_GE(corners.size(), 3U);
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const Cell a = corners[i], b = corners[(i + 1) % corners.size()],
                   c = corners[(i + 2) % corners.size()];
        ASSERT_GE(turned(a, b, c), 0);
        twice_area += std::int64_t{a.x} * b.y - std::int64_t{a.y} * b.x;
      }
    }
    ASSERT_EQ(twice_area, 2 * std::count(grid.cells.begin(), grid.cells.end(), 0));
    // As much area as there are free cells, none of it on a blocked cell: so nothing is covered twice
    // unless something is left out.
    for (int y = 0; y < grid.frame.height; ++y) {
      for (int x = 0; x < grid.frame.width; ++x) {
        const bool is_free = !oracle::blocked(grid, x, y);
        int around = 0, inside = 0;
        for (std::uint32_t p = 0; p < mesh.polygons(); ++p) {
          const auto corners = corners_of(mesh, p);
          around += holds(corners, {2 * x + 1, 2 * y + 1}, 2) ? 1 : 0;
          inside += holds(corners, {1009 * x + 499, 1009 * y + 313}, 1009) ? 1 : 0;  // on no side
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
  });
}

TEST_F(MeshOfRandomGrids, SidesFitTogetherAndTheOthersAreBorders) {
  each(600, 14, [](const Blocked& grid, const NavigationMesh& mesh) {
    for (std::uint32_t p = 0; p < mesh.polygons(); ++p) {
      for (std::uint32_t s = mesh.first[p]; s < mesh.first[p + 1]; ++s) {
        const Side& side = mesh.sides[s];
        const Cell a = side.at, b = end_of(mesh, p, s);
        if (side.behind != none) {
          const Side& behind = mesh.sides[side.behind];
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
  });
}

TEST_F(MeshOfRandomGrids, TurnsAreTheCornersOfOneBlockedCell) {
  each(300, 12, [](const Blocked& grid, const NavigationMesh& mesh) {
    std::set<std::pair<int, int>> turns;
    for (std::size_t t = 0; t + 1 < mesh.turns.size(); ++t) {
      const Cell v = mesh.turns[t].at;
      turns.insert({v.x, v.y});
      std::set<std::uint32_t> around;
      for (std::uint32_t i = mesh.turns[t].around; i < mesh.turns[t + 1].around; ++i) {
        const NavigationMesh::Wedge& wedge = mesh.around[i];
        ASSERT_EQ(mesh.sides[wedge.side].at, v);
        ASSERT_EQ(mesh.sides[wedge.side].turn, t);
        ASSERT_GE(wedge.side, mesh.first[wedge.polygon]);
        ASSERT_LT(wedge.side, mesh.first[wedge.polygon + 1]);
        const unsigned q = mesh.sides[wedge.side].blocked;
        ASSERT_TRUE(oracle::blocked(grid, v.x - ((q & 1U) != 0 ? 0 : 1), v.y - ((q & 2U) != 0 ? 0 : 1)));
        around.insert(wedge.polygon);
      }
      for (std::uint32_t p = 0; p < mesh.polygons(); ++p) {
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
  });
}

TEST_F(MeshOfRandomGrids, PolygonsAtACornerAreThoseThatHoldIt) {
  each(300, 12, [](const Blocked& grid, const NavigationMesh& mesh) {
    for (int y = 0; y <= grid.frame.height; ++y) {
      for (int x = 0; x <= grid.frame.width; ++x) {
        std::vector<std::uint32_t> found;
        for (const Cell c : {Cell{x, y}, Cell{x - 1, y}, Cell{x, y - 1}, Cell{x - 1, y - 1}}) {
          if (!oracle::blocked(grid, c.x, c.y)) mesh.polygons_at({x, y}, c, grid.frame, found);
        }
        std::sort(found.begin(), found.end());
        std::vector<std::uint32_t> expected;
        for (std::uint32_t p = 0; p < mesh.polygons(); ++p) {
          if (holds(corners_of(mesh, p), {x, y}, 1)) expected.push_back(p);
        }
        ASSERT_EQ(found, expected);
      }
    }
  });
}

/// Blocks crossed by any way from `here` to `to` that enters no polygon twice.
void cross(const NavigationMesh& mesh, std::uint32_t here, std::uint32_t to, std::vector<bool>& entered,
           std::vector<std::uint32_t>& way, std::set<std::uint32_t>& crossed) {
  if (here == to) crossed.insert(way.begin(), way.end());
  if (here == to) return;
  entered[here] = true;
  for (std::uint32_t s = mesh.first[here]; s < mesh.first[here + 1]; ++s) {
    const Side& side = mesh.sides[s];
    if (side.polygon == none || entered[side.polygon]) continue;
    way.push_back(side.block);
    cross(mesh, side.polygon, to, entered, way, crossed);
    way.pop_back();
  }
  entered[here] = false;
}

TEST_F(MeshOfRandomGrids, BlocksBetweenPolygonsAreThoseOnWaysWithoutDetours) {
  each(400, 6, [](const Blocked& /*grid*/, const NavigationMesh& mesh) {
    for (std::uint32_t a = 0; a < mesh.polygons(); ++a) {
      for (std::uint32_t b = 0; b < mesh.polygons(); ++b) {
        std::set<std::uint32_t> expected, found;
        std::vector<bool> entered(mesh.polygons(), false);
        std::vector<std::uint32_t> way;
        cross(mesh, a, b, entered, way, expected);
        ASSERT_EQ(mesh.part[a] == mesh.part[b], a == b || !expected.empty());
        if (mesh.part[a] != mesh.part[b]) continue;
        for (std::uint32_t x = a, y = b; x != y;) {
          std::uint32_t& lower = mesh.depth[x] >= mesh.depth[y] ? x : y;
          found.insert(mesh.up[lower]);
          lower = mesh.top[mesh.up[lower]];
        }
        ASSERT_EQ(found, expected);
      }
    }
  });
}

TEST(Mesh, OpenGroundIsOnePolygon) {
  const auto ground = GridGround::of(Blocked(GridFrame{{}, 1.0, 300, 200}), GridModel::corners);
  const NavigationMesh mesh = navigation_mesh(*ground);
  EXPECT_EQ(mesh.polygons(), 1U);
  EXPECT_EQ(mesh.sides.size(), 4U);
  EXPECT_EQ(mesh.turns.size(), 1U);
  EXPECT_GE(mesh.memory(), std::size_t{4} * 300 * 200);
}

TEST(Mesh, NoFreeCellNoPolygon) {
  const auto ground = GridGround::of(drawn({"##", "##"}), GridModel::corners);
  EXPECT_EQ(navigation_mesh(*ground).polygons(), 0U);
}

}  // namespace
}  // namespace outrider
