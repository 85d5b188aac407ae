#include "mesh/polyanya/taut_legs.hpp"

#include <gtest/gtest.h>

#include <set>

#include "mesh/mesh_blocks.hpp"
#include "support/grid_oracle.hpp"
#include "support/random_cases.hpp"
#include "support/random_grid.hpp"

namespace outrider::polyanya_search {
namespace {

using oracle::Blocked;

bool blocked_beside(const Blocked& grid, Cell v, int x, int y) {
  return oracle::blocked(grid, v.x + (x > 0 ? 0 : -1), v.y + (y > 0 ? 0 : -1));
}

/// Returns true if a path that arrives at a turn along `way` can bend around its blocked cell: that cell is
/// ahead on one side, and the path does not enter its quadrant.
bool can_bend(const Blocked& grid, Cell v, Arrow way) {
  for (const int x : {-1, 1}) {
    for (const int y : {-1, 1}) {
      if (!blocked_beside(grid, v, x, y)) continue;
      const int along_x = x * way.x, along_y = y * way.y;
      return (along_x < 0 && along_y >= 0) || (along_x >= 0 && along_y < 0);
    }
  }
  return false;
}

TEST(TautLegs, AreTheLinesOfSightBetweenTurnsAroundWhichAPathCanWind) {
  Rng rng = Rng(12).child("legs");
  int found = 0, behind = 0;
  for (int i = 0; i < outrider::testing::cases(150); ++i) {
    const Blocked grid = random_grid(rng, 11);
    const NavigationMesh mesh = navigation_mesh(GridMap::of(grid, GridModel::corners).value());
    TautLegs legs;
    for (const NavigationMesh::Side& side : mesh.sides) {
      for (const bool level : {false, true}) {
        if (side.turn == NavigationMesh::no_turn) continue;
        const Departure departure(side, level);
        int tries = 0;
        while (!legs.known(mesh, departure)) ASSERT_LT(++tries, 100);
        // Arrivals from everywhere in the quadrant, here from all turns that can be seen.
        for (const NavigationMesh::Turn& from : mesh.turns) {
          const Arrow came = arrow(from.at, side.at);
          bool along = false;
          if (!Departure::winds(side, came, along) || along != level) continue;
          if (!oracle::legal(grid, GridModel::corners, from.at, side.at)) continue;
          std::set<std::uint32_t> reached;
          legs.each(
              mesh, departure, came, [](std::uint32_t) { return true; },
              [&](const TautLegs::Leg& leg, std::uint32_t /*block*/) {
                reached.insert(leg.departure.turn());
              });
          const Cone cone = departure.cone(came);
          for (std::uint32_t turn = 0; turn < mesh.turns.size(); ++turn) {
            const Cell to = mesh.turns[turn].at;
            const Arrow way = arrow(side.at, to);
            const bool taut = !(to == side.at) && cone.holds(way) && can_bend(grid, to, way) &&
                              oracle::legal(grid, GridModel::corners, side.at, to);
            if (reached.count(turn) != 0) {
              ASSERT_TRUE(taut) << "grid " << i;
              ++found;
              continue;
            }
            if (!taut) continue;
            // Then another turn lies on the line.
            const bool hidden = std::any_of(mesh.turns.begin(), mesh.turns.end(), [&](const auto& other) {
              const Arrow part = arrow(side.at, other.at);
              return !(other.at == side.at) && !(other.at == to) && turned(part, way) == 0 &&
                     std::int64_t{part.x} * way.x + std::int64_t{part.y} * way.y > 0 &&
                     std::abs(part.x) + std::abs(part.y) < std::abs(way.x) + std::abs(way.y);
            });
            ASSERT_TRUE(hidden) << "grid " << i;
            ++behind;
          }
        }
      }
    }
  }
  EXPECT_GT(found, 5000);
  RecordProperty("behind", behind);
}

TEST(TautLegs, AreFoundAfterSomeExpansionsAndForgotten) {
  const NavigationMesh mesh =
      navigation_mesh(GridMap::of(drawn({"...", ".#.", "..."}), GridModel::corners).value());
  TautLegs legs;
  const auto side = std::find_if(mesh.sides.begin(), mesh.sides.end(),
                                 [](const auto& s) { return s.turn != NavigationMesh::no_turn; });
  const Departure departure(*side, true);
  EXPECT_FALSE(legs.known(mesh, departure));
  for (int i = 0; i < 100; ++i) legs.known(mesh, departure);
  EXPECT_TRUE(legs.known(mesh, departure));
  legs.forget();
  EXPECT_FALSE(legs.known(mesh, departure));
}

}  // namespace
}  // namespace outrider::polyanya_search
