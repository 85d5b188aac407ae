#include "ground/free_room.hpp"

#include <gtest/gtest.h>

#include "outrider/core/units.hpp"
#include "outrider/path/check.hpp"
#include "support/cover_areas.hpp"
#include "support/random_cases.hpp"

namespace outrider::cover {
namespace {

/// The judge of paths measures each piece exactly, in another way.
TEST(FreeRoom, AgreesWithExactClearances) {
  Rng rng(9);
  int free = 0, blocked = 0;
  for (int k = 0; k < testing::cases(20); ++k) {
    const CoverProblem problem = testing::random_cover_problem(rng);
    const auto ground = PolygonGround::of(problem.boundary, problem.holes, problem.radius_m());
    ASSERT_TRUE(ground);
    const FreeRoom room(*ground);
    for (int i = 0; i < 500; ++i) {
      const Vec2 from{rng.uniform(-5.0, 5.0), rng.uniform(-5.0, 5.0)};
      if (!room.point_free(from)) continue;
      PathPiece piece{from, from + rng.uniform(0.1, 4.0) * direction(rng.uniform(-pi, pi)), {}, 0.0};
      if (rng.below(3) > 0) {
        piece.centre = from + rng.uniform(0.1, 3.0) * direction(rng.uniform(-pi, pi));
        piece.turn_rad = rng.uniform(-6.0, 6.0);
        piece.to = piece.centre + rotated(piece.turn_rad, from - piece.centre);
      }
      Plan plan;
      plan.pieces = {piece};
      const double clearance = clearance_m(plan, *ground);
      if (std::abs(clearance - problem.radius_m()) < 1e-8) continue;
      EXPECT_EQ(room.free(piece), clearance > problem.radius_m()) << k << " " << i;
      ++(room.free(piece) ? free : blocked);
    }
  }
  EXPECT_GT(free, 500);
  EXPECT_GT(blocked, 500);
}

TEST(FreeRoom, TouchingIsFree) {
  const auto ground = PolygonGround::of({{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {}, 1.0);
  const FreeRoom room(*ground);
  EXPECT_TRUE(room.free(PathPiece{{1, 1}, {9, 1}, {}, 0.0}));
  EXPECT_TRUE(room.free(PathPiece{{9, 5}, {5, 9}, {5, 5}, 0.5 * pi})) << "an arc between two tangents";
  EXPECT_TRUE(room.free(PathPiece{{9, 5}, {9, 5}, {5, 5}, 2.0 * pi * (1.0 - 1e-12)}));
  EXPECT_FALSE(room.free(PathPiece{{9, 5}, {5, 9 + 1e-6}, {5, 5 + 1e-6}, 0.5 * pi}));
  EXPECT_NEAR(room.free_length({5, 5}, 0.0, 100.0), 4.0, 1e-8);
  EXPECT_EQ(room.free_length({5, 5}, 0.0, 3.0), 3.0);
}

}  // namespace
}  // namespace outrider::cover
