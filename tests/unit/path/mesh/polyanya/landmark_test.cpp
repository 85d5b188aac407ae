#include "mesh/polyanya/landmark.hpp"

#include <gtest/gtest.h>

#include "mesh/corner_distances.hpp"
#include "support/random_cases.hpp"
#include "support/random_grid.hpp"

namespace outrider::polyanya_search {
namespace {

using oracle::Blocked;

TEST(Landmark, TellsTheShortestLengthsToAllTurnsAndBoundsThoseToGates) {
  Rng rng = Rng(13).child("landmark");
  int turns = 0, gates = 0;
  for (int i = 0; i < outrider::testing::cases(400); ++i) {
    const Blocked grid = i % 4 == 0   ? mesh_oracle::maze(rng, 4, 1 + i % 3, true)
                         : i % 4 == 1 ? rooms(rng, 16)
                                      : random_grid(rng, 14);
    const GridMap ground = GridMap::of(grid, GridModel::corners).value();
    const NavigationMesh mesh = navigation_mesh(ground);
    const mesh_oracle::CornerDistances lengths(grid, ground);
    Landmark landmark;
    landmark.find(mesh);
    std::vector<Cell> landmarks;  // one for each component that has turns
    for (std::uint32_t turn = 0; turn < mesh.turns.size(); ++turn) {
      if (landmark.to(turn) == 0.0) landmarks.push_back(mesh.turns[turn].at);
    }
    const auto length_to = [&](Cell v) {
      double least = std::numeric_limits<double>::infinity();
      for (const Cell from : landmarks) least = std::min(least, lengths.between(from, v));
      return least;
    };
    for (std::uint32_t turn = 0; turn < mesh.turns.size(); ++turn) {
      ASSERT_NEAR(landmark.to(turn), length_to(mesh.turns[turn].at), 1e-9) << "grid " << i;
      ++turns;
    }
    for (std::uint32_t block = 0; block < mesh.top.size(); ++block) {
      if (!landmark.is_gate(block)) continue;
      const Gate& gate = landmark.gate(block);
      for (const Cell end : {gate.a, gate.b}) {
        if (ground.pinch(end)) continue;
        ASSERT_GE(gate.most + 1e-9, length_to(end)) << "grid " << i;
        ++gates;
      }
    }
    for (std::uint32_t p = 0; p < mesh.polygons(); ++p) {
      const Cell corner = mesh.sides[mesh.first[p]].at;
      if (ground.pinch(corner)) continue;
      ASSERT_LE(landmark.least_to(mesh, {p}, corner), length_to(corner) + 1e-9) << "grid " << i;
    }
  }
  EXPECT_GT(turns, 5000);
  EXPECT_GT(gates, 2000);
}

TEST(Landmark, MeasuresTheDistanceToAGate) {
  const Gate gate{{0, 0}, {4, 0}};
  EXPECT_DOUBLE_EQ(gate.distance({2, 3}), 3.0);
  EXPECT_DOUBLE_EQ(gate.distance({7, 4}), 5.0);
  EXPECT_DOUBLE_EQ(gate.distance({-3, 4}), 5.0);
}

}  // namespace
}  // namespace outrider::polyanya_search
