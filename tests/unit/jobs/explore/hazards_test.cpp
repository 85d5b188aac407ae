// The report of an exploration about what it could not see, against the exact reachability of the true world.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "box_solid.hpp"
#include "outrider/jobs/explore/run.hpp"
#include "support/costly_cases.hpp"

namespace outrider {
namespace {

/// Two rooms of 2 m x 2 m, with a wall of 1 m between them that has a corridor of that width, with its middle
/// at y.
World rooms(double corridor_m, double y) {
  World world;
  const double low = y - 0.5 * corridor_m, high = y + 0.5 * corridor_m;
  world.solids = {
      testing::box("south", {-0.1, -0.1}, {5.1, 0.0}), testing::box("north", {-0.1, 2.0}, {5.1, 2.1}),
      testing::box("west", {-0.1, 0.0}, {0.0, 2.0}),   testing::box("east", {5.0, 0.0}, {5.1, 2.0}),
      testing::box("below", {2.0, 0.0}, {3.0, low}),   testing::box("above", {2.0, high}, {3.0, 2.0})};
  world.bounds = {{-0.1, -0.1}, {5.1, 2.1}};
  return world;
}

ExploreTask task_at(Pose2 start, double radius_m) {
  ExploreTask task;
  task.start = start;
  task.robot.radius_m = radius_m;
  task.slam.trust_odometry = true;
  task.rules.most_time_s = 600.0;
  return task;
}

ExplorerSimParams exact_wheels() {
  ExplorerSimParams params;
  params.wheels.scale_error = params.wheels.noise_m = 0.0;
  return params;
}

Outcome<ExploreRun> explored(const World& world, double radius_m, std::uint64_t seed,
                             double gap_margin_m = ExploreOptions{}.gap_margin_m) {
  Log log;
  ExploreTask task = task_at({{0.7, 1.0}, 0.0}, radius_m);
  task.explore.gap_margin_m = gap_margin_m;
  return run_explore(world, task, exact_wheels(), seed, log);
}

/// Returns true if the disk can be swept to the place: the reference floods the true world exactly.
bool reaches(const World& world, double radius_m, Vec2 place) {
  RobotModel robot = burger();
  robot.radius_m = radius_m;
  const auto truth =
      exploration_reference(RangeFinder(world, {}), OpenGround(world, robot), {0.7, 1.0}, 0.0, 0.01);
  return truth->places[truth->places.frame.cell_at(place)] == reachable;
}

TEST(ExploreHazards, PassesACorridorThatIsWideEnoughWhereverItLiesOnTheMap) {
  Rng rng(1);
  for (int n = 0; n < testing::costly_cases(1); ++n) {
    const World world = rooms(0.4, 1.0 + rng.uniform(-0.05, 0.05));
    ASSERT_TRUE(reaches(world, 0.19, {4.0, 1.0}));
    const auto run = explored(world, 0.19, 1 + static_cast<std::uint64_t>(n), 0.0);
    ASSERT_TRUE(run);
    EXPECT_EQ(run->stop_reason, "complete") << n << ' ' << run->report.reason;
    EXPECT_GE(metric(run->report, "explored_fraction"), 0.99) << n;
    EXPECT_EQ(metric(run->report, "left_over_m2"), 0.0);
  }
}

TEST(ExploreHazards, IsDoneBeforeACorridorThatIsTooNarrowAndSaysHowWideItIs) {
  Rng rng(2);
  for (int n = 0; n < testing::costly_cases(1); ++n) {
    const World world = rooms(0.4, 1.0 + rng.uniform(-0.05, 0.05));
    ASSERT_FALSE(reaches(world, 0.21, {4.0, 1.0}));
    const auto run = explored(world, 0.21, 1 + static_cast<std::uint64_t>(n));
    ASSERT_TRUE(run);
    EXPECT_EQ(run->report.status, "done") << run->report.reason;
    EXPECT_GE(metric(run->report, "explored_before_gaps"), 0.99);
    EXPECT_GE(metric(run->report, "left_narrow"), 1.0);
    EXPECT_GE(metric(run->report, "left_over_m2"), 1.0);
    const Table& left = table_named(run->report, "left_over");
    double widest_m = 0.0;
    for (const auto& row : left.rows) widest_m = std::max(widest_m, TableRow{left, row}.number("width_m"));
    EXPECT_NEAR(widest_m, 0.4, 0.03) << run->report.reason;
    EXPECT_EQ(metric(run->report, "returned_home"), 1.0);
  }
}

TEST(ExploreHazards, MayLeaveAGapInWhichItFitsWithLessRoomThanItWants) {
  const double radius_m = burger().radius_m;
  const World world = rooms(2.0 * radius_m + 0.015, 0.975);
  ASSERT_TRUE(reaches(world, radius_m, {4.0, 0.975}));
  const auto run = explored(world, radius_m, 2);
  ASSERT_TRUE(run);
  EXPECT_EQ(run->report.status, "done") << run->report.reason;
  EXPECT_EQ(metric(run->report, "false_complete"), 0.0);
  EXPECT_TRUE(metric(run->report, "left_narrow") > 0.0 || metric(run->report, "explored_fraction") >= 0.99);
}

TEST(ExploreHazards, NeverSaysCompleteWhereTheRobotCouldHaveSeenMore) {
  Rng rng(3);
  int complete = 0, behind_gap = 0;
  for (int n = 0; n < testing::costly_cases(3); ++n) {
    const double corridor_m = rng.uniform(0.15, 0.7);
    const World world = rooms(corridor_m, rng.uniform(0.6, 1.4));
    const double radius_m = rng.uniform(0.1, 0.25);
    const auto run = explored(world, radius_m, static_cast<std::uint64_t>(n));
    ASSERT_TRUE(run) << run.error().sentence;
    const bool passes = reaches(world, radius_m, {4.0, 1.0});
    if (run->stop_reason == "complete") {
      EXPECT_GE(metric(run->report, "explored_before_gaps"), 0.99) << n;
      const bool sees_all = metric(run->report, "explored_fraction") >= 0.99;
      EXPECT_TRUE(passes || !sees_all) << n << ": nobody sees all of the other room through " << corridor_m;
      EXPECT_TRUE(sees_all || metric(run->report, "left_narrow") > 0.0)
          << n << ": it does not name the corridor of " << corridor_m << " m, r " << radius_m;
      ++(sees_all ? complete : behind_gap);
    } else {
      EXPECT_EQ(run->report.status, "not_done");
      EXPECT_FALSE(run->report.reason.empty());
    }
  }
  if (!testing::in_full()) return;
  EXPECT_GE(complete, 1);
  EXPECT_GE(behind_gap, 1);
}

/// A room of 2.5 m x 2 m in which a wall ends beside a sofa: between the two is a gap of 0.6 m length, which
/// a robot enters around both corners.
World room_with_gap(double gap_m) {
  World world;
  world.solids = {
      testing::box("south", {-0.1, -0.1}, {2.6, 0.0}), testing::box("north", {-0.1, 2.0}, {2.6, 2.1}),
      testing::box("west", {-0.1, 0.0}, {0.0, 2.0}),   testing::box("east", {2.5, 0.0}, {2.6, 2.0}),
      testing::box("wall", {1.1, 0.0}, {1.2, 1.2}),    testing::box("sofa", {1.2 + gap_m, 0.4}, {2.5, 1.0})};
  world.bounds = {{-0.1, -0.1}, {2.6, 2.1}};
  return world;
}

TEST(ExploreHazards, LooksAtAGapThatIsHardlyWideEnoughAndDoesNotTouchItsSides) {
  ExploreTask task;
  task.start = {{0.5, 1.6}, 0.0};
  int narrow = 0, passed = 0;
  for (int n = 0; n < testing::costly_cases(4); ++n) {
    const double gap_m = n % 2 == 0 ? 0.20 + 0.02 * (n % 8) / 8.0 : 0.3;  // the robot is 0.21 m wide
    Log log;
    const auto run = run_explore(room_with_gap(gap_m), task, {}, 1 + static_cast<std::uint64_t>(n), log);
    ASSERT_TRUE(run) << run.error().sentence;
    EXPECT_EQ(metric(run->report, "visible_contacts"), 0.0) << gap_m << " m, seed " << n + 1;
    narrow += metric(run->report, "left_narrow") > 0.0 ? 1 : 0;
    passed += run->report.status == "done" && n % 2 == 1 ? 1 : 0;
  }
  if (!testing::in_full()) return;
  EXPECT_GE(narrow, 1);
  EXPECT_GE(passed, 1);
}

/// A pane in a corridor that the robot cannot turn in once it has touched it: it gets wedged.
TEST(ExploreHazards, ARobotThatIsWedgedAtAGlassPaneEndsAndSaysSo) {
  World world = rooms(0.9, 1.0);
  world.solids.push_back(testing::box("glass", {2.4, 0.5}, {2.43, 1.5}, 0.16));  // the laser is at 0.18 m
  world.solids.push_back(testing::box("screen", {4.0, 0.0}, {4.1, 1.5}));
  ASSERT_FALSE(reaches(world, burger().radius_m, {4.5, 1.0}));
  const auto run = explored(world, burger().radius_m, 1);
  ASSERT_TRUE(run);
  EXPECT_EQ(run->report.status, "not_done");
  EXPECT_NE(run->stop_reason, "complete");
  EXPECT_FALSE(run->report.reason.empty());
  EXPECT_GE(metric(run->report, "contacts"), 1.0);
  EXPECT_LE(metric(run->report, "time_s"), 600.0) << "it does not try for ever";
}

TEST(ExploreHazards, DrivesAroundATableBelowItsLaserAndIsDone) {
  World world = rooms(1.8, 1.0);
  world.solids.push_back(testing::box("table", {1.3, 0.8}, {1.6, 1.2}, 0.15));
  world.solids.push_back(testing::box("screen", {4.0, 0.0}, {4.1, 1.4}));
  const auto run = explored(world, burger().radius_m, 2);
  ASSERT_TRUE(run);
  EXPECT_EQ(run->report.status, "done") << run->report.reason;
  EXPECT_GE(metric(run->report, "explored_fraction"), 0.99);
  EXPECT_GE(metric(run->report, "contacts"), 1.0) << "it can find the table by its bumper only";
  EXPECT_EQ(metric(run->report, "visible_contacts"), 0.0);
  EXPECT_EQ(metric(run->report, "home_error_m"), distance(run->true_pose.position, Vec2{0.7, 1.0}));
  EXPECT_EQ(metric(run->report, "pose_error_m"), distance(run->true_pose.position, run->pose.position));
}

}  // namespace
}  // namespace outrider
