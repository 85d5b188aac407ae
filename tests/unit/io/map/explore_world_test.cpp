#include "outrider/io/map/world_file.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "outrider/io/map/map_server.hpp"
#include "support/data.hpp"

namespace outrider {
namespace {

std::string files_fault(const ExploreWorldFiles& files) {
  const auto loaded = load_explore_world(files);
  return loaded ? "none" : loaded.error().sentence;
}

bool stands(const World& world, Vec2 p, double z_m = 0.18) {
  return std::ranges::any_of(world.solids, [&](const Solid& solid) {
    return !std::holds_alternative<HalfSpaceShape>(solid.shape) && distance({p.x, p.y, z_m}, solid) == 0.0;
  });
}

const std::string map_yaml = "image: m.pgm\nresolution: 0.5\norigin: [1, 2, 1.5707963267948966]\n";

TEST(ExploreWorld, AllThatIsNotKnownToBeFreeStandsOnAMap) {
  const test::Folder folder;
  // Top row first: free, occupied, unknown; below it: three free.
  folder.write("m.pgm", "P2 3 2 255\n254 0 205\n254 254 254\n");
  const auto loaded = load_explore_world({.world = folder.write("m.yaml", map_yaml)});
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  const World& world = loaded->world;
  EXPECT_EQ(world.name, "m");
  EXPECT_EQ(world.floor_z_m, 0.0);
  const auto map = load_map_server((folder.path / "m.yaml").string());
  ASSERT_TRUE(map);
  for (int y = -1; y <= 2; ++y) {
    for (int x = -1; x <= 3; ++x) {
      const bool free = map->occupancy.contains({x, y}) && map->occupancy[{x, y}] == free_cell;
      EXPECT_EQ(stands(world, world_centre(*map, {x, y})), !free) << x << ' ' << y;
    }
  }
  // A quarter turn about (1, 2): the ring of 5 x 4 cells spans x from 1 - 1.5 to 1 + 0.5.
  EXPECT_NEAR(world.bounds.low.x, -0.5, 1e-9);
  EXPECT_NEAR(world.bounds.high.x, 1.5, 1e-9);
  EXPECT_NEAR(world.bounds.low.y, 1.5, 1e-9);
  EXPECT_NEAR(world.bounds.high.y, 4.0, 1e-9);
}

TEST(ExploreWorld, AnImageAloneLiesAtTheOrigin) {
  const test::Folder folder;
  const auto loaded = load_explore_world(
      {.world = folder.write("m.pgm", "P2 3 1 255\n254 0 254\n"), .options = {.resolution_m = 0.2}});
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  EXPECT_FALSE(stands(loaded->world, {0.1, 0.1}));
  EXPECT_TRUE(stands(loaded->world, {0.3, 0.1}));
  EXPECT_FALSE(stands(loaded->world, {0.5, 0.1}));
  EXPECT_TRUE(stands(loaded->world, {0.7, 0.1})) << "beyond the edge all is unknown";
}

TEST(ExploreWorld, SlicesAndWallsStandInIt) {
  const test::Folder folder;
  const std::string slices = folder.write("s.csv", "0,0,4,0\na,b,1,1,2,1,2,2,1,2\n");
  const auto loaded = load_explore_world({.world = slices, .slices = slices, .walls = "0,3,4,3 4,3,4,0"});
  ASSERT_TRUE(loaded) << to_string(loaded.error());
  const World& world = loaded->world;
  EXPECT_EQ(world.solids.size(), 7U) << "the floor, twice two slices, two walls";
  EXPECT_TRUE(stands(world, {1.5, 1.5}));
  EXPECT_TRUE(stands(world, {2.0, 3.0}));
  EXPECT_TRUE(stands(world, {2.0, 0.0}));
  EXPECT_FALSE(stands(world, {2.0, 0.5}));
  EXPECT_FALSE(stands(world, {1.5, 1.5}, 0.6)) << "above the walls";
  EXPECT_NEAR(world.bounds.high.y, 3.0, 1e-9);
}

TEST(ExploreWorld, WhatIsNoWorldIsRefused) {
  const test::Folder folder;
  EXPECT_EQ(files_fault({}), "missing; give the file of the world to explore");
  EXPECT_EQ(files_fault({.world = folder.write("m.txt", "x")}),
            "the name does not tell what kind of world it is; worlds end in .sdf, .world, .yaml, .yml, .pgm, "
            ".png or .csv (.gz may follow)");
  EXPECT_EQ(files_fault({.world = folder.write("m.pgm", "P2 2 1 255\n0 205\n")}),
            "the map has no free cell; check its thresholds and whether it is negated");
  EXPECT_EQ(files_fault({.world = folder.write("e.csv", "# nothing\n")}),
            "nothing stands in this world; there is nothing to explore");
  const std::string good = folder.write("s.csv", "0,0,4,0\n");
  EXPECT_EQ(files_fault({.world = good, .walls = "1,1,1,1"}),
            "the wall 1,1,1,1 has no length; give its two ends");
  EXPECT_NE(files_fault({.world = good, .walls = "1,1,2"}), "none");
  EXPECT_NE(files_fault({.world = good, .slices = (folder.path / "absent.csv").string()}), "none");
}

}  // namespace
}  // namespace outrider
