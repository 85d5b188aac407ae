#include "outrider/io/explore_world.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "data.hpp"
#include "outrider/core/units.hpp"
#include "outrider/io/explore_scenario.hpp"
#include "outrider/io/map_server.hpp"
#include "outrider/io/scenario.hpp"

namespace outrider {
namespace {

std::string fault_of(const ExploreWorldFiles& files) {
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
  const auto loaded =
      load_explore_world({.world = folder.write("m.pgm", "P2 3 1 255\n254 0 254\n"), .resolution_m = 0.2});
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
  EXPECT_EQ(fault_of({}), "missing; give the file of the world to explore");
  EXPECT_EQ(fault_of({.world = folder.write("m.txt", "x")}),
            "the name does not tell what kind of world it is; worlds end in .sdf, .world, .yaml, .yml, .pgm, "
            ".png or .csv (.gz may follow)");
  EXPECT_EQ(fault_of({.world = folder.write("m.pgm", "P2 2 1 255\n0 205\n")}),
            "the map has no free cell; check its thresholds and whether it is negated");
  EXPECT_EQ(fault_of({.world = folder.write("e.csv", "# nothing\n")}),
            "nothing stands in this world; there is nothing to explore");
  const std::string good = folder.write("s.csv", "0,0,4,0\n");
  EXPECT_EQ(fault_of({.world = good, .walls = "1,1,1,1"}),
            "the wall 1,1,1,1 has no length; give its two ends");
  EXPECT_NE(fault_of({.world = good, .walls = "1,1,2"}), "none");
  EXPECT_NE(fault_of({.world = good, .slices = (folder.path / "absent.csv").string()}), "none");
}

TEST(ExploreScenario, KeysAndTextsBecomeASetup) {
  const test::Folder folder;
  folder.write("s.csv", "0,0,4,0\n");
  const std::string path =
      folder.write("e.yaml",
                   "job: explore\nworld: s.csv\nstart: \"1,2,90\"\nseed: 4\n"
                   "laser:\n  most: 5\nwheels:\n  scale_error: 0\nslam:\n  laser_x: 0.1\n"
                   "rules:\n  return_home: false\n");
  ExploreScenario scenario;
  ASSERT_TRUE(load_scenario(path, describe(scenario)));
  resolve_paths(scenario, path);
  const auto setup = load_explore(scenario);
  ASSERT_TRUE(setup) << to_string(setup.error());
  EXPECT_EQ(setup->task.start, (Pose2{{1.0, 2.0}, radians(90.0)}));
  EXPECT_EQ(setup->truth.laser.most_m, 5.0);
  EXPECT_EQ(setup->truth.wheels.scale_error, 0.0);
  EXPECT_EQ(setup->truth.laser.robot_T_laser.position.x, 0.1) << "as the robot knows it";
  EXPECT_FALSE(setup->task.rules.return_home);
  EXPECT_EQ(setup->task.robot.radius_m, 0.105) << "a TurtleBot3 burger";
}

TEST(ExploreScenario, WhatIsNoGoodIsRefused) {
  const auto fault = [](auto change) {
    ExploreScenario scenario;
    scenario.world.world = "s.csv";
    change(scenario);
    const auto setup = load_explore(scenario);
    return setup ? "none" : to_string(setup.error());
  };
  EXPECT_EQ(fault([](auto& s) { s.job = "guard"; }),
            "job: 'guard' is not a job of this scenario; the job is explore");
  EXPECT_EQ(fault([](auto& s) { s.start = "1,2"; }).substr(0, 6), "start:");
  EXPECT_EQ(fault([](auto& s) { s.truth.laser.least_m = 4.0; }),
            "laser.least: '4' is no good; it takes less than laser.most, which is 3.5 m");
  EXPECT_EQ(fault([](auto& s) { s.world.world = ""; }),
            "world: missing; give the file of the world to explore");
}

}  // namespace
}  // namespace outrider
