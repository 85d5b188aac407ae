#include "strokes/laps.hpp"

#include <gtest/gtest.h>

#include "support/cover_areas.hpp"
#include "support/random_cases.hpp"

namespace outrider::cover {
namespace {

const std::vector<Vec2> square = {{0, 0}, {6, 0}, {6, 6}, {0, 6}};

TEST(Laps, GoRoundEverythingOnceAndClose) {
  const auto ground = PolygonGround::of(square, {{{2, 2}, {4, 2}, {4, 4}, {2, 4}}}, 0.5);
  ASSERT_TRUE(ground);
  const auto laps = laps_of(*ground);
  ASSERT_EQ(laps.size(), 2U);
  double lengths[2] = {};
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t k = 0; k < laps[i].size(); ++k) {
      EXPECT_LE(distance(laps[i][k].to, laps[i][(k + 1) % laps[i].size()].from), contact_m);
      lengths[i] += length_of(laps[i][k]);
    }
  }
  EXPECT_NEAR(lengths[0], 20.0, 1e-9);                  // inside of the walls
  EXPECT_NEAR(lengths[1], 8.0 + 2.0 * pi * 0.5, 1e-9);  // around the hole
  const Lap back = turned_round(begun_at(laps[1], 3));
  EXPECT_EQ(back.back().to, laps[1][3].from);
  EXPECT_NEAR(heading_out(back.back()), wrap_angle(heading_in(laps[1][3]) + pi), 1e-9);
}

/// Round random areas: as long as the border of the standing room.
TEST(Laps, AreAsLongAsTheBorderOfTheStandingRoom) {
  Rng rng(31);
  for (int k = 0; k < testing::cases(10); ++k) {
    const CoverProblem problem = testing::random_cover_problem(rng);
    const auto ground = PolygonGround::of(problem.boundary, problem.holes, problem.radius_m());
    ASSERT_TRUE(ground);
    double length = 0.0, border = 0.0;
    for (const Lap& lap : laps_of(*ground)) {
      EXPECT_LE(distance(lap.back().to, lap.front().from), contact_m) << k;
      for (const PathPiece& piece : lap) length += length_of(piece);
    }
    const auto add = [&](const std::vector<Vec2>& ring) {
      for (std::size_t i = 0; i < ring.size(); ++i) border += distance(ring[i], ring[(i + 1) % ring.size()]);
    };
    for (const RingedPolygon& part :
         shrunk(region_of(problem.boundary, problem.holes), problem.radius_m(), 1e-5)) {
      add(part.outer);
      for (const auto& hole : part.holes) add(hole);
    }
    EXPECT_NEAR(length, border, 1e-3 * border) << k;
  }
}

}  // namespace
}  // namespace outrider::cover
