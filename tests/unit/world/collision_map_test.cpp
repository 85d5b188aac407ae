#include "outrider/world/collision_map.hpp"

#include <gtest/gtest.h>

#include "support/random_cases.hpp"

namespace outrider {
namespace {

using testing::cases;
using testing::random_point;
using testing::random_rounded_polygon;

constexpr Box2 yard{{-6.0, -4.0}, {6.0, 4.0}};

std::vector<RoundedPolygon> random_obstacles(Rng& rng, std::size_t count) {
  std::vector<RoundedPolygon> obstacles;
  for (std::size_t i = 0; i < count; ++i) {
    RoundedPolygon obstacle = random_rounded_polygon(rng, 0.7);
    const Vec2 shift = random_point(rng, 7.0);  // some of them outside the yard
    for (Vec2& p : obstacle.core) p = p + shift;
    obstacles.push_back(std::move(obstacle));
  }
  return obstacles;
}

double edge_distance(Vec2 p) {
  return std::min({p.x - yard.low.x, yard.high.x - p.x, p.y - yard.low.y, yard.high.y - p.y});
}

TEST(CollisionMap, ClearanceAgainstAllObstacles) {
  Rng rng(1);
  for (int round = 0; round < cases(50); ++round) {
    const CollisionMap ground(yard, random_obstacles(rng, rng.below(40)));
    for (int i = 0; i < 100; ++i) {
      const Vec2 p = random_point(rng, 8.0);
      const double most = rng.uniform(0.1, 3.0);
      double expected = std::min(most, edge_distance(p));
      for (const RoundedPolygon& o : ground.obstacles()) expected = std::min(expected, signed_distance(p, o));
      EXPECT_EQ(ground.clearance(p, most), expected);
    }
  }
}

TEST(CollisionMap, SegmentFreeAgainstAllObstacles) {
  Rng rng(2);
  int free = 0;
  int blocked = 0;
  for (int round = 0; round < cases(50); ++round) {
    const CollisionMap ground(yard, random_obstacles(rng, rng.below(12)));
    for (int i = 0; i < 100; ++i) {
      const Segment s{random_point(rng, 6.0), random_point(rng, 6.0)};
      const double radius = rng.uniform(0.0, 0.5);
      bool expected = std::min(edge_distance(s.a), edge_distance(s.b)) >= radius - 1e-9;
      for (const RoundedPolygon& o : ground.obstacles()) {
        expected = expected && signed_distance(s, o) >= radius - 1e-9;
      }
      EXPECT_EQ(ground.segment_free(s, radius), expected);
      ++(expected ? free : blocked);
    }
  }
  EXPECT_GT(free, 200);
  EXPECT_GT(blocked, 200);
}

TEST(CollisionMap, AFreeSegmentKeepsItsClearanceAlongTheWay) {
  Rng rng(3);
  for (int round = 0; round < cases(50); ++round) {
    const CollisionMap ground(yard, random_obstacles(rng, 8));
    for (int i = 0; i < 50; ++i) {
      const Segment s{random_point(rng, 4.0), random_point(rng, 4.0)};
      double least = 1.0;
      for (int k = 0; k <= 200; ++k) {
        least = std::min(least, ground.clearance(s.a + k / 200.0 * (s.b - s.a), 1.0));
      }
      if (ground.segment_free(s, 0.26)) {
        EXPECT_GE(least, 0.26 - 1e-8);
      } else {
        EXPECT_LE(least, 0.26 + norm(s.b - s.a) / 200);
      }
    }
  }
}

TEST(CollisionMap, ContactIsAllowed) {
  const CollisionMap ground(yard, {RoundedPolygon{{{0.0, 0.0}}, 1.0}});
  EXPECT_TRUE(ground.segment_free({{-3.0, 1.26}, {3.0, 1.26}}, 0.26));
  EXPECT_FALSE(ground.segment_free({{-3.0, 1.25}, {3.0, 1.25}}, 0.26));
  EXPECT_TRUE(ground.segment_free({{5.74, 0.0}, {5.74, 2.0}}, 0.26)) << "along the edge of the yard";
  EXPECT_FALSE(ground.segment_free({{5.75, 0.0}, {5.75, 2.0}}, 0.26));
}

TEST(CollisionMap, AnEmptyYardHasOnlyItsEdge) {
  const CollisionMap ground(yard, {});
  EXPECT_EQ(ground.clearance({0, 0}, 10.0), 4.0);
  EXPECT_EQ(ground.clearance({0, 0}, 1.0), 1.0);
  EXPECT_EQ(ground.clearance({7, 0}, 1.0), -1.0);
}

TEST(CollisionMap, OneDrivesUnderATableBetweenItsLegs) {
  World world;
  world.bounds = yard;
  world.solids.push_back({"ground", {}, HalfSpaceShape{}});
  world.solids.push_back({"top", {{0, 0, 0.7}, {}}, BoxShape{{1.0, 1.0, 0.02}}});
  for (const Vec2 leg : {Vec2{-1, -1}, Vec2{1, -1}, Vec2{1, 1}, Vec2{-1, 1}}) {
    world.solids.push_back({"leg", {{leg.x, leg.y, 0.35}, {}}, CylinderShape{0.05, 0.35}});
  }
  const CollisionMap low = CollisionMap::of(world, 0.2);
  EXPECT_EQ(low.obstacles().size(), 4U);
  EXPECT_TRUE(low.segment_free({{-3, 0}, {3, 0}}, 0.26));
  EXPECT_FALSE(low.segment_free({{-3, 0.9}, {3, 0.9}}, 0.26));

  const CollisionMap tall = CollisionMap::of(world, 0.8);
  EXPECT_EQ(tall.obstacles().size(), 5U);
  EXPECT_FALSE(tall.segment_free({{-3, 0}, {3, 0}}, 0.26));
}

TEST(CollisionMap, ALowStepIsDrivenOver) {
  World world;
  world.bounds = yard;
  world.floor_z_m = 1.0;
  world.solids.push_back({"mat", {{0, 0, 1.005}, {}}, BoxShape{{1.0, 1.0, 0.005}}});
  EXPECT_EQ(CollisionMap::of(world, 0.2).obstacles().size(), 1U);
  EXPECT_EQ(CollisionMap::of(world, 0.2, 0.02).obstacles().size(), 0U);
}

TEST(CollisionMap, BoundsOfAnySizeAreServed) {
  const CollisionMap huge({{-1e6, -1e6}, {1e6, 1e6}}, {RoundedPolygon{{{0, 0}}, 1.0}});
  EXPECT_EQ(huge.clearance({2, 0}, 5.0), 1.0);
  const CollisionMap thin({{0, 0}, {1e5, 1e-3}}, {});
  EXPECT_DOUBLE_EQ(thin.clearance({10, 5e-4}, 1.0), 5e-4);
  const CollisionMap nothing(Box2{}, {RoundedPolygon{{{0, 0}}, 1.0}});
  EXPECT_LT(nothing.clearance({0, 0}, 1.0), 0.0);
  EXPECT_FALSE(nothing.segment_free({{0, 0}, {1, 0}}, 0.1));
}

}  // namespace
}  // namespace outrider
