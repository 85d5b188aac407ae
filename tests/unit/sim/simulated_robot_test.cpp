#include "outrider/sim/simulated_robot.hpp"

#include <gtest/gtest.h>

namespace outrider {
namespace {

const Chassis chassis = mecanum_chassis(0.03, 0.1225);

WheelBody wheels(const Pose2& start = {}) { return {chassis, {}, {}, 1e9, start, Rng(1)}; }

SimulatedTagCamera camera(const TagSightFaults& faults) {
  TagScene scene{{}, {{upright_tag(1, {2, 0, 0.2}, pi)}}};
  scene.world.bounds = {{-5, -5}, {5, 5}};
  return {scene, {{}, looking_ahead({0.0, 0.0, 0.2})}, {.rate_hz = 10.0}, faults, false, Rng(1)};
}

Command stand_until(double time_s) { return DriveWheels{{}, time_s}; }

TEST(SimulatedRobot, ACommandThatItsBodyDoesNotKnowTakesNoTime) {
  SimulatedRobot robot(wheels());
  robot.act(DriveTwist{{1.0, 0.0, 0.0}, 5.0});
  robot.act(Wait{5.0});
  EXPECT_EQ(robot.time_s(), 0.0);
  EXPECT_EQ(robot.pose(), Pose2{});
}

TEST(SimulatedRobot, HasTheDevicesThatItWasGivenOnly) {
  SimulatedRobot robot(wheels());
  robot.act(stand_until(1.0));
  const Observation seen = robot.sense();
  EXPECT_EQ(seen.time_s, 1.0);
  EXPECT_FALSE(seen.scan || seen.image || seen.gun || seen.stores || seen.targets || seen.grid);
}

TEST(SimulatedRobot, ItsCameraTakesImagesOfItsOwnWhileACommandLasts) {
  SimulatedRobot robot(wheels(), {.camera = camera({.missed = 0.0})});
  EXPECT_FALSE(robot.sense().image) << "the first is due at 0.1 s";
  robot.act(stand_until(0.25));
  const Observation seen = robot.sense();
  ASSERT_TRUE(seen.image);
  EXPECT_EQ(seen.image->taken_s, 0.2);
  EXPECT_EQ(seen.image->sightings.size(), 1U);
  EXPECT_EQ(robot.devices().camera->images(), 2);
  robot.act(stand_until(0.26));
  EXPECT_EQ(robot.sense().image->taken_s, 0.2) << "the newest one, seen before";
  robot.act(stand_until(0.3));
  EXPECT_EQ(robot.sense().image->taken_s, 3 / 10.0) << "due as the command ends";
}

TEST(SimulatedRobot, ABlindCameraTakesImagesWithoutTags) {
  SimulatedRobot robot(wheels(), {.camera = camera({.missed = 0.0, .blind_from_s = 0.15})});
  robot.act(stand_until(0.1));
  EXPECT_EQ(robot.sense().image->sightings.size(), 1U);
  robot.act(stand_until(0.2));
  EXPECT_TRUE(robot.sense().image->sightings.empty());
}

TEST(SimulatedRobot, IsKidnappedOnce) {
  SimulatedRobot robot(wheels({{1.0, 2.0}, 0.0}), {}, {.at_s = 0.5, .by_m = 0.8, .by_rad = 0.3});
  robot.act(stand_until(0.4));
  EXPECT_EQ(robot.pose(), (Pose2{{1.0, 2.0}, 0.0}));
  for (const double time_s : {0.6, 1.2}) {
    robot.act(stand_until(time_s));
    EXPECT_NEAR(distance(robot.pose().position, Vec2{1.0, 2.8}), 0.0, 1e-12);
    EXPECT_NEAR(robot.pose().heading_rad, 0.3, 1e-12);
  }
}

}  // namespace
}  // namespace outrider
