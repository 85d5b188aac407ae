#include "outrider/world/world.hpp"

#include <gtest/gtest.h>

namespace outrider {
namespace {

TEST(World, WithGivesANewOne) {
  const World empty;
  const World one = empty.with({"crate", {{1, 2, 0.5}, {}}, BoxShape{{0.5, 0.5, 0.5}}});
  EXPECT_TRUE(empty.solids.empty());
  ASSERT_EQ(one.solids.size(), 1U);
  EXPECT_EQ(one.solids[0].name, "crate");
}

TEST(World, StandingBoundsAreTheBoxOfTheWalls) {
  World world;
  EXPECT_TRUE(standing_bounds(world).empty());
  world.solids.push_back({"ground", {}, HalfSpaceShape{}});
  world.solids.push_back({"paint", {{50, 50, 0.0}, {}}, BoxShape{{1, 1, 0.001}}});
  world.solids.push_back({"pit", {{-50, 0, -2.0}, {}}, SphereShape{1.0}});
  EXPECT_TRUE(standing_bounds(world).empty());
  world.solids.push_back({"west", {{-5, 0, 1}, {}}, BoxShape{{0.1, 4, 1}}});
  world.solids.push_back({"post", {{6, 1, 1}, {}}, CylinderShape{0.5, 1}});
  const Box2 yard = standing_bounds(world);
  EXPECT_DOUBLE_EQ(yard.low.x, -5.1);
  EXPECT_DOUBLE_EQ(yard.low.y, -4.0);
  EXPECT_DOUBLE_EQ(yard.high.x, 6.5);
  EXPECT_DOUBLE_EQ(yard.high.y, 4.0);
}

}  // namespace
}  // namespace outrider
