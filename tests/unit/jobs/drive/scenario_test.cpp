#include "outrider/jobs/drive/scenario.hpp"

#include <gtest/gtest.h>

#include "outrider/core/units.hpp"
#include "outrider/io/scenario/scenario.hpp"
#include "support/cart.hpp"
#include "support/data.hpp"

namespace outrider {
namespace {

Outcome<DriveSetup> loaded(const std::string& text) {
  DriveScenario scenario;
  if (auto ok = scenario_from_text(text, "drive.yaml", describe(scenario)); !ok) return pass_on(ok);
  return load_drive(scenario);
}

TEST(DriveScenario, WaypointsAndTags) {
  const auto setup = loaded(
      "waypoints: \"1,0,0 1,2,180! 0,0,360\"\ntags: \"1=2,1,180 7=0,2,0,0.5\"\nsight: "
      "modelled\n");
  ASSERT_TRUE(setup) << to_string(setup.error());
  ASSERT_EQ(setup->task.waypoints.size(), 3U);
  EXPECT_EQ(setup->task.waypoints[1], (Waypoint{{{1, 2}, pi}, false}));
  EXPECT_NEAR(setup->task.waypoints[2].pose.heading_rad, 2.0 * pi, 1e-12);
  EXPECT_FALSE(setup->rendered);
  ASSERT_EQ(setup->task.tags.tags.size(), 2U);
  EXPECT_EQ(setup->task.tags.tags[0].world_T_tag.position.z, setup->task.eye.height_m);
  EXPECT_EQ(setup->task.tags.tags[1].world_T_tag.position.z, 0.5);
  EXPECT_TRUE(setup->task.world.bounds.contains({-1, -1}));
}

TEST(DriveScenario, TheRobotAndTheMountOfItsCameraMayComeFromItsFile) {
  const test::Folder folder;
  const std::string keys =
      "waypoints: 1,0,0\nrobot_file: " + folder.write("cart.urdf", test::cart_urdf) + "\ncamera:\n  link: ";
  const auto setup = loaded(keys + "camera_link\n");
  ASSERT_TRUE(setup) << to_string(setup.error());
  EXPECT_NEAR(setup->task.radius_m, 0.3, 1e-9);
  EXPECT_NEAR(setup->task.eye.ahead_m, 0.2, 1e-9);
  EXPECT_NEAR(setup->task.eye.height_m, 0.25, 1e-9);
  const std::string refused = to_string(loaded(keys + "laser\n").error());
  EXPECT_EQ(refused.substr(0, 62), "camera.link: the x axis of 'laser' does not point ahead on the")
      << refused;
}

TEST(DriveScenario, AGoalAndAPlannerBecomeWaypoints) {
  const auto setup = loaded("start: 0.5,0.5,0\ngoal: 2.5,2,90\nplanner: a_star\nbounds: 0,0,3,3\n");
  ASSERT_TRUE(setup) << to_string(setup.error());
  ASSERT_TRUE(setup->plan);
  EXPECT_EQ(setup->task.waypoints.back().pose.position, (Vec2{2.5, 2.0}));
  EXPECT_NEAR(setup->path_clearance_m, 0.5, 0.06);
}

TEST(DriveScenario, APlannerWithoutABudgetHasNoWay) {
  const std::string drive = "start: 0.5,0.5,0\ngoal: 2.5,2,90\nplanner: a_star\nbounds: 0,0,3,3\n";
  const auto setup = loaded(drive + "faults:\n  planner_fails_from: 0\n");
  ASSERT_FALSE(setup);
  EXPECT_EQ(setup.error().code, FaultCode::budget_exhausted);
  const auto where = [](const std::string& text) {
    const auto refused = loaded(text);
    return refused ? "none" : refused.error().where;
  };
  EXPECT_EQ(where(drive + "faults:\n  planner_fails_from: 3\n"), "faults.planner_fails_from");
  EXPECT_EQ(where("waypoints: 1,0,0\nfaults:\n  planner_fails_from: 0\n"), "faults.planner_fails_from");
}

TEST(DriveScenario, TextOfAllKeysReadsBack) {
  DriveScenario scenario;
  EXPECT_TRUE(scenario_from_text(scenario_text(describe(scenario)), "all.yaml", describe(scenario)));
}

TEST(DriveScenario, Refusals) {
  const auto refused = [](const std::string& text, const std::string& says) {
    const auto setup = loaded(text);
    ASSERT_FALSE(setup) << text;
    EXPECT_NE(to_string(setup.error()).find(says), std::string::npos) << to_string(setup.error());
  };
  const std::string way = "waypoints: 1,0,0\n";
  refused("", "waypoints: there are none");
  refused("waypoints: 1,0\n", "waypoints: '1,0' is not valid");
  refused("waypoints: 1,0,0!\n", "the last one is a stop");
  refused(way + "goal: 1,1,0\n", "planner: a goal and a planner go together");
  refused(way + "goal: 1,1,0\nplanner: a_star\n", "goal: there are waypoints as well");
  refused("goal: 1,1,0\nplanner: a_starr\n", "did you mean 'a_star'?");
  refused(way + "tags: 2,1,180\n", "tags: '2,1,180' is no tag");
  refused(way + "tags: 1=2,1\n", "tags: '2,1' is not valid");
  refused(way + "tags: \"1=2,1,180 1=0,0,0\"\n", "tags:");
  refused(way + "tags: 9999=2,1,180\n", "tags:");
  refused(way + "tag_size: 0\n", "tag_size");
  refused(way + "tag_family: tag36h12\n", "tag_family: there is no family of tags 'tag36h12'");
  refused(way + "tag_family: all\n", "tag_family: it takes one family");
  refused(way + "tags: 30=2,1,180\ntag_family: tag16h5\n", "ids go from 0 to 29");
  refused(way + "camera:\n  fx: 0\n", "camera.fx");
  refused(way + "loop: shut\n", "loop: 'shut' is not valid; expected closed or open");
  refused(way + "sight: blind\n", "rendered or modelled");
  refused(way + "chassis: tank\n", "there is no chassis 'tank'");
  refused(way + "chassis: differential\n", "take rotate_then_go");
  refused(way + "follow:\n  follower: pidd\n", "did you mean 'pid'?");
  refused(way + "bounds: 1,1,0,0\n", "the low corner comes first");
  refused(way + "bounds: -1,-1,1.1,1\n", "waypoint 1 at 1,0 is 0.1 m from an obstacle or the edge");
  refused(way + "calibration: none.yaml\n", "none.yaml");
  refused(way + "world: none.sdf\n", "none.sdf");
}

}  // namespace
}  // namespace outrider
