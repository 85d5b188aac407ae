#include "outrider/world/level_layers.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "outrider/core/rng.hpp"

namespace outrider {
namespace {

Solid box(Vec3 middle, Vec3 size, double turn_rad = 0.0) {
  return {"box", {middle, Rotation::from_rpy(0, 0, turn_rad)}, BoxShape{0.5 * size}};
}

Solid mesh(std::vector<std::array<Vec3, 3>> triangles) {
  return {"mesh", {}, MeshShape{std::move(triangles)}};
}

const Box2 hall{{0, 0}, {10, 10}};

TEST(LevelLayers, CountOverlapsOnceAndOnlyWithinTheBox) {
  World world;
  world.solids = {box({2.5, 5, 0}, {5, 10, 0.2}), box({5, 5, 0.01}, {6, 10, 0.2}),
                  box({15, 5, 0}, {10, 10, 0.2})};
  const auto layers = level_layers(world, hall, 50.0);
  ASSERT_EQ(layers.size(), 1U);
  EXPECT_DOUBLE_EQ(layers[0].height_m, 0.11);
  EXPECT_NEAR(layers[0].covered_m2, 80.0, 1.0);
  EXPECT_TRUE(level_layers(world, hall, 85.0).empty());
  EXPECT_TRUE(level_layers(world, Box2{}, 0.0).empty());
}

TEST(LevelLayers, TakeTrianglesThatFaceUpOrDownButNoSlopes) {
  const Vec3 a{0, 0, 1};
  const Vec3 b{10, 0, 1};
  const Vec3 c{10, 10, 1};
  const Vec3 d{0, 10, 1};
  World world;
  world.solids = {mesh({{a, b, c}, {c, a, d}})};
  const auto floor = level_layers(world, hall, 90.0);
  ASSERT_EQ(floor.size(), 1U);
  EXPECT_NEAR(floor[0].covered_m2, 100.0, 1.5);
  world.solids = {mesh({{a, b, Vec3{10, 10, 2}}, {a, Vec3{10, 10, 2}, Vec3{0, 10, 2}}})};
  EXPECT_TRUE(level_layers(world, hall, 10.0).empty());
}

TEST(LevelLayers, ComeFromLowToHigh) {
  World world;
  for (const double z : {3.0, 0.0, 0.5}) world.solids.push_back(box({5, 5, z}, {10, 10, 0.1}));
  const auto layers = level_layers(world, hall, 90.0);
  ASSERT_EQ(layers.size(), 3U);
  EXPECT_DOUBLE_EQ(layers[0].height_m, 0.05);
  EXPECT_DOUBLE_EQ(layers[1].height_m, 0.55);
  EXPECT_DOUBLE_EQ(layers[2].height_m, 3.05);
}

/// The covered area by random places: another way to count.
TEST(LevelLayers, CoverWhatRandomPlacesFindCovered) {
  Rng rng(7);
  for (int round = 0; round < 20; ++round) {
    World world;
    for (int i = 0; i < 12; ++i) {
      const Vec3 middle{rng.uniform(0, 10), rng.uniform(0, 10), rng.uniform(0, 0.02)};
      world.solids.push_back(box(middle, {rng.uniform(1, 5), rng.uniform(1, 5), 0.2}, rng.uniform(0, 3)));
    }
    int inside = 0;
    constexpr int places = 20'000;
    for (int i = 0; i < places; ++i) {
      const Vec3 p{rng.uniform(0, 10), rng.uniform(0, 10), 0.05};
      if (std::ranges::any_of(world.solids, [&](const Solid& solid) { return distance(p, solid) == 0.0; }))
        ++inside;
    }
    const auto layers = level_layers(world, hall, 1.0);
    ASSERT_EQ(layers.size(), 1U);
    EXPECT_NEAR(layers[0].covered_m2, 100.0 * inside / places, 2.0);
  }
}

}  // namespace
}  // namespace outrider
