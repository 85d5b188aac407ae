#include "outrider/world/changes.hpp"

#include <gtest/gtest.h>

#include "outrider/core/rng.hpp"
#include "outrider/core/units.hpp"

namespace outrider {
namespace {

Solid box(const std::string& name, Vec3 at, Vec3 half, double yaw_rad = 0.0) {
  return {name, {at, Rotation::from_rpy(0.0, 0.0, yaw_rad)}, BoxShape{half}};
}

/// A shed of two walls, a bench, a post, on a floor.
World yard_of_sheds() {
  World world;
  world.bounds = {{-10, -10}, {10, 10}};
  world.solids = {Solid{"floor", {}, HalfSpaceShape{}},
                  box("shed/wall", {2, 0, 1}, {1, 0.1, 1}),
                  box("shed/side/left", {3, 1, 1}, {0.1, 1, 1}),
                  box("bench", {-4, 2, 0.25}, {1, 0.25, 0.25}, 0.4),
                  box("bench_2", {-4, 5, 0.25}, {1, 0.25, 0.25}),
                  Solid{"post", {{5, 5, 1}, {}}, CylinderShape{0.1, 1.0}}};
  return world;
}

std::string refusal(const WorldChanges& changes) {
  const auto world = changed(yard_of_sheds(), changes);
  EXPECT_FALSE(world.has_value());
  return world ? "" : to_string(world.error());
}

const Solid& solid_named(const World& world, const std::string& name) {
  return *std::ranges::find(world.solids, name, &Solid::name);
}

TEST(WorldChanges, AThingIsMovedAndTurnedAboutTheMiddleOfItsBox) {
  const auto world = changed(yard_of_sheds(), {{{"shed", {{0, -5}, pi / 2}}}, {}});
  ASSERT_TRUE(world.has_value()) << world.error().sentence;
  // The box around both walls is [1, 3.1] x [-0.1, 2]; its middle (2.05, 0.95) comes to (0, -5).
  const Vec3 wall = solid_named(*world, "shed/wall").world_T_solid.position;
  EXPECT_NEAR(wall.x, 0.95, 1e-12);
  EXPECT_NEAR(wall.y, -5.05, 1e-12);
  EXPECT_NEAR(wall.z, 1.0, 1e-12);
  EXPECT_EQ(solid_named(*world, "bench").world_T_solid.position.x, -4.0);
  EXPECT_EQ(world->bounds.low.x, -10.0);
}

/// Whatever is inside a thing before is inside it afterwards, at the place that the rigid motion takes it to.
TEST(WorldChanges, PointsOfAThingGoWithIt) {
  Rng rng = Rng(3).child("changes");
  const World before = yard_of_sheds();
  for (int i = 0; i < 50; ++i) {
    const Pose2 to{{rng.uniform(-8, 8), rng.uniform(-8, 8)}, rng.uniform(-pi, pi)};
    for (const MovableThing& thing : movable_things(before)) {
      const auto after = changed(before, {{{thing.name, to}}, {}});
      ASSERT_TRUE(after.has_value());
      for (const std::size_t k : thing.solids) {
        const Box3 around = bounds(before.solids[k]);
        for (int n = 0; n < 40; ++n) {
          const Vec3 p{rng.uniform(around.low.x, around.high.x), rng.uniform(around.low.y, around.high.y),
                       rng.uniform(around.low.z, around.high.z)};
          const double c = std::cos(to.heading_rad), s = std::sin(to.heading_rad);
          const Vec2 away = xy(p) - thing.middle;
          const Vec3 q{to.position.x + c * away.x - s * away.y, to.position.y + s * away.x + c * away.y, p.z};
          EXPECT_NEAR(distance(p, before.solids[k]), distance(q, after->solids[k]), 1e-9) << thing.name;
        }
      }
    }
  }
}

TEST(WorldChanges, OnAHillItKeepsItsHeightAboveTheGround) {
  World world = yard_of_sheds();
  const auto field = HeightField::make({-10, -10}, {10, 10}, 3, 3, {0, 1, 2, 0, 1, 2, 0, 1, 2});
  ASSERT_TRUE(field.has_value());
  world = world.on(std::make_shared<const HeightField>(*field));
  const auto moved = changed(world, {{{"post", {{-5, 5}, 0.0}}}, {}});
  ASSERT_TRUE(moved.has_value());
  EXPECT_NEAR(solid_named(*moved, "post").world_T_solid.position.z - 1.0,
              world.ground_z_m({-5, 5}) - world.ground_z_m({5, 5}), 1e-12);
}

TEST(WorldChanges, ANameStandsForItsPartsAndNotForWhatOnlyBeginsLikeIt) {
  const auto world = changed(yard_of_sheds(), {{{"shed/side", {}}, {"bench_2", {{1, 2}, 0.05}}}, {"bench"}});
  ASSERT_TRUE(world.has_value()) << world.error().sentence;
  EXPECT_EQ(world->solids.size(), yard_of_sheds().solids.size() - 1);
  EXPECT_EQ(solid_named(*world, "shed/wall").world_T_solid.position.x, 2.0);
  EXPECT_NEAR(solid_named(*world, "shed/side/left").world_T_solid.position.x, 0.0, 1e-12);
  EXPECT_NEAR(solid_named(*world, "bench_2").world_T_solid.position.y, 2.0, 1e-12);
}

TEST(WorldChanges, WhatCanBeMovedLeavesOutTheGround) {
  std::vector<std::string> names;
  for (const MovableThing& thing : movable_things(yard_of_sheds())) names.push_back(thing.name);
  EXPECT_EQ(names, (std::vector<std::string>{"shed", "bench", "bench_2", "post"}));
}

TEST(WorldChanges, WrongWordsAreRefusedWithTheKeyAndWhatWouldBeRight) {
  EXPECT_EQ(refusal({{{"bench_3", {}}}, {}}),
            "moved: nothing in the world is named 'bench_3'; near to it are 'bench_2', 'bench'");
  EXPECT_EQ(refusal({{}, {"shed/wal"}}),
            "removed: nothing in the world is named 'shed/wal'; near to it are 'shed/wall', 'shed'");
  EXPECT_EQ(refusal({{}, {"qqqqqqqqqq"}}),
            "removed: nothing in the world is named 'qqqqqqqqqq'; take one of shed, bench, bench_2, post");
  EXPECT_EQ(refusal({{{"floor", {}}}, {}}),
            "moved: 'floor' is the ground, which stays; name what stands on it");
  EXPECT_EQ(refusal({{{"shed", {}}}, {"shed/wall"}}),
            "removed: 'shed/wall' is named twice, in moved or removed; leave one out");
}

}  // namespace
}  // namespace outrider
