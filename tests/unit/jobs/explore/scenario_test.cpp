#include "outrider/job/run_job.hpp"
#include "outrider/jobs/explore/job.hpp"

#include <gtest/gtest.h>

#include "outrider/core/units.hpp"
#include "support/cart.hpp"
#include "support/data.hpp"

namespace outrider {
namespace {

TEST(ExploreScenario, KeysAndTextsBecomeASetup) {
  const test::Folder folder;
  folder.write("s.csv", "0,0,4,0\n4,0,4,3\n");
  const std::string path =
      folder.write("e.yaml",
                   "job: explore\nworld: s.csv\nstart: \"1,2,90\"\nseed: 4\n"
                   "laser:\n  most: 5\nwheels:\n  scale_error: 0\nslam:\n  laser_x: 0.1\n"
                   "rules:\n  return_home: false\n");
  ExploreJob job;
  ASSERT_TRUE(read_scenario(job, path));
  const auto setup = load_explore(job.scenario);
  ASSERT_TRUE(setup) << to_string(setup.error());
  EXPECT_EQ(setup->task.start, (Pose2{{1.0, 2.0}, radians(90.0)}));
  EXPECT_EQ(setup->sim.laser.most_m, 5.0);
  EXPECT_EQ(setup->sim.wheels.scale_error, 0.0);
  EXPECT_EQ(setup->sim.laser.robot_T_laser.position.x, 0.1) << "as the robot knows it";
  EXPECT_FALSE(setup->task.rules.return_home);
  EXPECT_EQ(setup->task.robot.radius_m, 0.105) << "a TurtleBot3 burger";
}

TEST(ExploreScenario, TheRobotAndTheMountOfItsLaserMayComeFromItsFile) {
  const test::Folder folder;
  folder.write("s.csv", "0,0,4,0\n4,0,4,3\n");
  folder.write("cart.urdf", test::cart_urdf);
  const auto load = [&](const std::string& keys) {
    ExploreJob job;
    const std::string path = folder.write("e.yaml", "job: explore\nworld: s.csv\nstart: \"1,2,90\"\n" + keys);
    EXPECT_TRUE(read_scenario(job, path));
    return load_explore(job.scenario);
  };
  const auto setup = load("robot:\n  file: cart.urdf\nlaser:\n  link: laser\n");
  ASSERT_TRUE(setup) << to_string(setup.error());
  EXPECT_NEAR(setup->task.robot.radius_m, 0.3, 1e-9);
  EXPECT_NEAR(setup->sim.laser.height_m, 0.5, 1e-9);
  EXPECT_NEAR(setup->sim.laser.robot_T_laser.position.x, 0.1, 1e-9);
  EXPECT_NEAR(setup->task.slam.robot_T_laser.heading_rad, radians(90.0), 1e-9);
  const auto refused = [&](const std::string& keys) { return to_string(load(keys).error()); };
  EXPECT_EQ(refused("laser:\n  link: laser\n"),
            "laser.link: links are those of the robot's own file; name it, or leave the link out");
  EXPECT_EQ(refused("robot:\n  file: cart.urdf\nlaser:\n  link: lase\n"),
            "laser.link: there is no link or frame 'lase'; did you mean 'laser'?");
  EXPECT_EQ(refused("robot:\n  file: cart.urdf\nlaser:\n  link: tilted\n").substr(0, 11), "laser.link:");
}

TEST(ExploreScenario, WhatIsNoGoodIsRefused) {
  const auto fault = [](auto change) {
    ExploreScenario scenario;
    scenario.world.world = "s.csv";
    change(scenario);
    const auto setup = load_explore(scenario);
    return setup ? "none" : to_string(setup.error());
  };
  EXPECT_EQ(fault([](auto& s) { s.start = "1,2"; }).substr(0, 6), "start:");
  EXPECT_EQ(fault([](auto& s) { s.sim.laser.least_m = 4.0; }),
            "laser.least: '4' is not valid; expected less than laser.most, which is 3.5 m");
  const test::Folder folder;
  const std::string hall = folder.write("h.csv", "0,0,100,0\n100,0,100,100\n");
  const auto cells = [&](double resolution_m, double most_m) {
    return fault([&](auto& s) {
      s.world.world = hall;
      s.start = "1,1,0";
      s.task.slam.map.resolution_m = resolution_m;
      s.sim.laser.most_m = most_m;
    });
  };
  EXPECT_EQ(
      cells(0.01, 100.0),
      "occupancy.resolution: '0.01' is not valid: a scan would cover 100 million cells of this world, and at "
      "most 10 million are kept; expected at least 0.032 m");
  EXPECT_EQ(cells(0.032, 100.0), "none");
  EXPECT_EQ(cells(0.01, 3.5), "none");
  const std::string walls = folder.write("s.csv", "0,0,4,0\n4,0,4,3\n");
  EXPECT_EQ(fault([&](auto& s) {
              s.world.world = walls;
              s.start = "1,8,0";
            }),
            "start: (1, 8) is outside the map, which lies between (0, 0) and (4, 3); start it in there");
  const auto post = [&](const std::string& place, double at_s) {
    return fault([&](auto& s) {
      s.world.world = walls;
      s.start = "1,1,0";
      s.blocked_place = place;
      s.sim.faults.walk_ins.blocked_at_s = at_s;
    });
  };
  EXPECT_EQ(post("2,1.5", 5.0), "none");
  EXPECT_EQ(post("2", 5.0), "faults.blocked_place: '2' is not valid; expected x,y in m, such as 3.5,-2");
  EXPECT_EQ(post("2,9", 5.0),
            "faults.blocked_place: 2,9 is outside the map, which lies between (0, 0) and (4, 3); put the "
            "post in there");
  EXPECT_EQ(
      post("2,1.5", 1e9),
      "faults.blocked_place: a post is put at 2,1.5 at no time; give faults.blocked_at, or leave this out");
  EXPECT_EQ(fault([](auto& s) { s.world.world = ""; }),
            "world: missing; give the file of the world to explore");
}

}  // namespace
}  // namespace outrider
