#include "outrider/path/mesh/mesh.hpp"

#include <gtest/gtest.h>

#include "mesh_oracle.hpp"
#include "support/random_grid.hpp"

namespace outrider {
namespace {

using oracle::Blocked;

class MeshOfRandomGrids : public testing::Test {
 protected:
  template <class Check>
  void each(int count, int most_side, Check check) {
    Rng rng = Rng(5).child("mesh");
    for (int i = 0; i < count && !HasFatalFailure(); ++i) {
      const Blocked grid = random_grid(rng, most_side);
      const auto ground = GridMap::of(grid, GridModel::corners);
      ASSERT_TRUE(ground.has_value());
      SCOPED_TRACE(i);
      check(grid, navigation_mesh(*ground));
    }
  }
};

TEST_F(MeshOfRandomGrids, PolygonsAreConvexAndCoverTheFreeCellsOnce) {
  each(600, 14, mesh_oracle::expect_cover);
}

TEST_F(MeshOfRandomGrids, SidesFitTogetherAndTheOthersAreBorders) { each(600, 14, mesh_oracle::expect_fit); }

TEST_F(MeshOfRandomGrids, TurnsAreTheCornersOfOneBlockedCell) { each(300, 12, mesh_oracle::expect_turns); }

TEST_F(MeshOfRandomGrids, PolygonsAtACornerAreThoseThatHoldIt) {
  each(300, 12, mesh_oracle::expect_polygons_at);
}

TEST_F(MeshOfRandomGrids, BlocksBetweenPolygonsAreThoseOnWaysWithoutDetours) {
  each(400, 6, [](const Blocked& /*grid*/, const NavigationMesh& mesh) { mesh_oracle::expect_blocks(mesh); });
}

TEST(Mesh, OpenGroundIsOnePolygon) {
  const auto ground = GridMap::of(Blocked(GridFrame{{}, 1.0, 300, 200}), GridModel::corners);
  const NavigationMesh mesh = navigation_mesh(*ground);
  EXPECT_EQ(mesh.polygons(), 1U);
  EXPECT_EQ(mesh.sides.size(), 4U);
  EXPECT_TRUE(mesh.turns.empty());
  EXPECT_GE(mesh.memory(), std::size_t{4} * 300 * 200);
}

TEST(Mesh, AStopLeavesNone) {
  const auto ground = GridMap::of(drawn({"...", ".#.", "..."}), GridModel::corners);
  std::stop_source source;
  ASSERT_GT(navigation_mesh(*ground, source.get_token()).polygons(), 0U);
  source.request_stop();
  EXPECT_EQ(navigation_mesh(*ground, source.get_token()).polygons(), 0U);
}

TEST(Mesh, NoFreeCellNoPolygon) {
  const auto ground = GridMap::of(drawn({"##", "##"}), GridModel::corners);
  EXPECT_EQ(navigation_mesh(*ground).polygons(), 0U);
}

}  // namespace
}  // namespace outrider
