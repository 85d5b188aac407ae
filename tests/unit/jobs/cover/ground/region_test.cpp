#include "outrider/jobs/cover/ground/region.hpp"

#include <gtest/gtest.h>

#include "outrider/core/units.hpp"
#include "support/cover_areas.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

const std::vector<Vec2> square = {{0, 0}, {4, 0}, {4, 4}, {0, 4}};
const std::vector<Vec2> hole = {{1, 1}, {2, 1}, {2, 2}, {1, 2}};

TEST(Region, ASquareWithAHoleOfEitherOrientation) {
  std::vector<Vec2> turned(hole.rbegin(), hole.rend());
  for (const auto& ring : {hole, turned}) {
    const Region region = region_of(square, {ring});
    ASSERT_EQ(region.size(), 1U);
    EXPECT_NEAR(area_of(region), 15.0, 1e-9);
    EXPECT_TRUE(contains(region, {0.5, 0.5}));
    EXPECT_TRUE(contains(region, {1.0, 1.5})) << "on the border";
    EXPECT_FALSE(contains(region, {1.5, 1.5}));
    EXPECT_FALSE(contains(region, {5.0, 1.5}));
    EXPECT_NEAR(distance_to_border(region.front(), {0.5, 1.5}), 0.5, 1e-9);
  }
}

TEST(Region, GrowingFollowsSteiner) {
  const Region region = region_of(square, {});
  EXPECT_NEAR(area_of(grown(region, 0.5, 1e-5)), 16.0 + 16.0 * 0.5 + pi * 0.25, 1e-3);
  EXPECT_NEAR(area_of(shrunk(region, 0.5, 1e-5)), 9.0, 1e-5);
  EXPECT_TRUE(shrunk(region, 2.1, 1e-5).empty());
  // Opened by a disk, a square loses its corners: (4 - pi) r^2.
  EXPECT_NEAR(area_of(grown(shrunk(region, 0.5, 1e-5), 0.5, 1e-5)), 16.0 - (4.0 - pi) * 0.25, 1e-3);
}

TEST(Region, AlgebraAgreesWithPoints) {
  Rng rng(11);
  for (int k = 0; k < testing::cases(20); ++k) {
    const Region a = region_of(testing::random_star(rng, {0, 0}, 1, 3, 7), {});
    const Region b = region_of(testing::random_star(rng, {1, 0}, 1, 3, 6), {});
    const Region c = region_of(testing::random_star(rng, {0, 1}, 1, 3, 5), {});
    const Region either = united(a, b), both = common(a, b), only = without(a, b);
    const Region any = united(std::vector<Region>{a, b, c});
    EXPECT_NEAR(area_of(either) + area_of(both), area_of(a) + area_of(b), 1e-4);
    EXPECT_NEAR(area_of(only) + area_of(both), area_of(a), 1e-4);
    for (int i = 0; i < 50; ++i) {
      const Vec2 p = testing::random_point(rng, 4.0);
      const bool in_a = contains(a, p), in_b = contains(b, p), in_c = contains(c, p);
      EXPECT_EQ(contains(either, p), in_a || in_b);
      EXPECT_EQ(contains(both, p), in_a && in_b);
      EXPECT_EQ(contains(only, p), in_a && !in_b);
      EXPECT_EQ(contains(any, p), in_a || in_b || in_c);
    }
  }
}

}  // namespace
}  // namespace outrider
