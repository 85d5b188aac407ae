// Explorations with faults that the robot is not told: done only if the map is right and the robot is home.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <stop_token>
#include <utility>

#include "box_solid.hpp"
#include "outrider/core/units.hpp"
#include "outrider/jobs/explore/run.hpp"
#include "outrider/slam/scan/scan_contradiction.hpp"

namespace outrider {
namespace {

/// A room of 4 x 3 m with a chest.
World room() {
  World world;
  world.solids = {testing::box("south", {-0.2, -0.2}, {4.2, 0.0}),
                  testing::box("north", {-0.2, 3.0}, {4.2, 3.2}),
                  testing::box("west", {-0.2, 0.0}, {0.0, 3.0}), testing::box("east", {4.0, 0.0}, {4.2, 3.0}),
                  testing::box("chest", {2.2, 1.2}, {2.8, 1.6})};
  world.bounds = {{-0.2, -0.2}, {4.2, 3.2}};
  return world;
}

ExploreRun explored(const ExplorerFaults& faults, const LinkFaults& link = {}) {
  ExploreTask task;
  task.start = {{1.0, 1.0}, 0.0};
  task.rules.most_time_s = 200.0;
  ExplorerSimParams params;
  params.faults = faults;
  params.link = link;
  Log log;
  auto run = run_explore(room(), task, params, 1, log);
  EXPECT_TRUE(run) << run.error().sentence;
  EXPECT_EQ(run->report.reason.empty(), run->report.status == "done");
  if (run->report.status == "done") {
    EXPECT_LT(distance(run->true_pose.position, task.start.position), 0.3);
    EXPECT_LE(metric(run->report, "map_error_m"), 0.1);
    EXPECT_GE(metric(run->report, "explored_fraction"), 0.9);
    EXPECT_EQ(metric(run->report, "visible_contacts"), 0.0);
  }
  return std::move(*run);
}

TEST(ExploreFaults, WithoutScansItIsBlind) {
  ExplorerFaults faults;
  faults.blind_from_s = 4.0;
  EXPECT_EQ(explored(faults).stop_reason, "blind");
}

TEST(ExploreFaults, AFrozenSensorIsBlind) {
  ExplorerFaults faults;
  faults.frozen_from_s = 4.0;
  EXPECT_EQ(explored(faults).stop_reason, "blind");
}

TEST(ExploreFaults, ABiasThatSpoilsTheMapIsNotDone) {
  ExplorerFaults faults;
  faults.bias_m = -0.3;
  EXPECT_EQ(explored(faults).report.status, "not_done");
}

/// The robot does not call a map complete that it cannot believe itself.
TEST(ExploreFaults, ARangeFinderThatIsOffIsNotBelieved) {
  ExplorerFaults off, strewn;
  off.bias_m = 0.15;
  strewn.outliers = 0.1;
  for (const ExplorerFaults& faults : {off, strewn}) {
    const ExploreRun run = explored(faults);
    EXPECT_EQ(run.stop_reason, "lost") << run.report.reason;
    EXPECT_EQ(metric(run.report, "false_complete"), 0.0);
  }
}

TEST(ExploreFaults, OthersEndHonestly) {
  ExplorerFaults late, slips, stuck, kidnapped;
  late.latency_s = 0.4;
  slips.slip = 0.2;
  stuck.stuck_from_s = 5.0;
  kidnapped.kidnapping.at_s = 5.0;
  for (const ExplorerFaults& faults : {late, slips, stuck, kidnapped}) explored(faults);
}

TEST(ExploreFaults, WithoutAnyItIsDoneAndAClockThatJumpsOrAPlannerThatPausesLeavesItSo) {
  const ExploreRun undisturbed = explored({});
  EXPECT_EQ(undisturbed.report.status, "done");
  const double undisturbed_s = metric(undisturbed.report, "time_s");
  for (const double jump_s : {-1000.0, 3.0}) {
    ExplorerFaults faults;
    faults.clock = {5.0, jump_s};
    const ExploreRun run = explored(faults);
    EXPECT_EQ(run.report.status, "done") << run.report.reason;
    EXPECT_NEAR(metric(run.report, "time_s"), undisturbed_s, 1e-6);
  }
  for (const PlannerOutage outage : {PlannerOutage{3.0, 3.0}, {12.0, 15.0}}) {
    ExplorerFaults faults;
    faults.planner = outage;
    const ExploreRun run = explored(faults);
    EXPECT_EQ(run.report.status, "done") << outage.for_s << ": " << run.report.reason;
    EXPECT_NE(metric(run.report, "time_s"), undisturbed_s) << "it has waited";
  }
}

TEST(ExploreFaults, APostThatIsPutInItsWayIsNotTouched) {
  for (const double for_s : {5.0, 1e9}) {
    ExplorerFaults faults;
    faults.walk_ins.blocked_at_s = 4.0;
    faults.walk_ins.blocked_for_s = for_s;
    const ExploreRun run = explored(faults);
    EXPECT_GE(metric(run.report, "blocked_s"), 4.0);
    EXPECT_EQ(metric(run.report, "visible_contacts"), 0.0);
  }
}

/// Two rooms of 3 x 3 m with a door of 0.9 m between them.
World rooms_with_a_door() {
  World world;
  world.solids = {
      testing::box("south", {-0.2, -0.2}, {6.4, 0.0}), testing::box("north", {-0.2, 3.0}, {6.4, 3.2}),
      testing::box("west", {-0.2, 0.0}, {0.0, 3.0}),   testing::box("east", {6.2, 0.0}, {6.4, 3.0}),
      testing::box("below", {3.0, 0.0}, {3.2, 1.0}),   testing::box("above", {3.0, 1.9}, {3.2, 3.0}),
      testing::box("chest", {4.6, 0.4}, {5.0, 1.2})};
  world.bounds = {{-0.2, -0.2}, {6.4, 3.2}};
  return world;
}
constexpr Vec2 middle_of_door{3.1, 1.45};

ExploreRun run_behind_a_door(const ExplorerFaults& faults, const ScanHook& scanned,
                             std::stop_token stop = {}) {
  ExploreTask task;
  task.start = {{1.0, 1.5}, 0.0};
  task.rules.most_time_s = 60.0;
  ExplorerSimParams params;
  params.faults = faults;
  Log log;
  auto run = run_explore(rooms_with_a_door(), task, params, 1, log, {.stop = std::move(stop)}, scanned);
  EXPECT_TRUE(run) << run.error().sentence;
  return std::move(*run);
}

/// Explores the two rooms from the first; the door closes for so long once the robot is well in the second.
ExploreRun explored_behind_a_door(ExplorerFaults faults, double closed_for_s) {
  faults.walk_ins.blocked_for_s = closed_for_s;
  std::optional<double> closed_x;  // where the robot was then
  ExploreRun run =
      run_behind_a_door(faults, [&](const Observation&, const ExploreMission&, const SimulatedRobot& robot) {
        if (!closed_x && robot.body<TwistBody>().walk_ins().blocked_s()) closed_x = robot.pose().position.x;
      });
  EXPECT_GT(closed_x.value_or(0.0), 3.8) << "it is in the second room when the door closes";
  EXPECT_EQ(metric(run.report, "false_complete"), 0.0);
  return run;
}

TEST(ExploreFaults, ARobotBehindADoorThatClosesSaysThatItIsNotHomeUnlessTheDoorOpensAgain) {
  ExplorerFaults faults;
  faults.walk_ins.blocked_place = middle_of_door;
  faults.walk_ins.blocked_radius_m = 0.47;
  std::stop_source far_enough;
  const ScanHook look = [&](const Observation& seen, const ExploreMission&, const SimulatedRobot& robot) {
    if (robot.pose().position.x <= 4.2 || far_enough.stop_requested()) return;
    faults.walk_ins.blocked_at_s = seen.time_s;
    far_enough.request_stop();
  };
  run_behind_a_door({}, look, far_enough.get_token());

  const ExploreRun shut = explored_behind_a_door(faults, 1e9);
  EXPECT_EQ(shut.report.status, "not_done");
  EXPECT_FALSE(shut.report.reason.empty());
  EXPECT_GT(shut.true_pose.position.x, 3.2);
  const ExploreRun opened = explored_behind_a_door(faults, 10.0);
  EXPECT_EQ(opened.report.status, "done") << opened.report.reason;
  EXPECT_LT(opened.true_pose.position.x, 2.0);
}

TEST(ExploreFaults, APlannerWithoutABudgetEndsTheMissionWithThatReason) {
  ExplorerFaults faults;
  faults.planner.from_s = 3.0;
  const ExploreRun run = explored(faults);
  EXPECT_EQ(run.stop_reason, "stuck");
  EXPECT_NE(run.report.reason.find("the budget ended"), std::string::npos) << run.report.reason;
  EXPECT_LT(metric(run.report, "time_s"), 100.0);
}

TEST(ExploreFaults, PeopleWhoWalkThroughAreNotTouched) {
  ExplorerFaults faults;
  faults.walk_ins.people = 2;
  EXPECT_EQ(metric(explored(faults).report, "visible_contacts"), 0.0);
}

TEST(ExploreFaults, ALinkThatLosesRepeatsOrReordersScansEndsHonestly) {
  LinkFaults down, repeats, reorders;
  down.down_from_s = 4.0;
  repeats.repeated = 0.3;
  reorders.reordered = 0.3;
  EXPECT_EQ(explored({}, down).stop_reason, "blind");
  for (const LinkFaults& link : {repeats, reorders}) EXPECT_EQ(explored({}, link).report.status, "done");
}

/// The robot compares scans at home: one taken 0.5 m away contradicts the first one, one taken 0.1 m away
/// does not.
TEST(ExploreFaults, AScanFromElsewhereContradictsTheFirstOne) {
  const RangeFinder laser(room(), {});
  Rng rng(1);
  const Pose2 home{{1.0, 1.0}, 0.0};
  const LaserScan first = laser.look(home, 0.0, rng);
  for (int turn = 0; turn < 8; ++turn) {
    const Vec2 towards = direction(0.25 * pi * turn);
    const LaserScan near = laser.look({home.position + 0.1 * towards, 0.02}, 1.0, rng);
    EXPECT_LT(contradiction(first, home, near, home), 0.05) << turn;
    const LaserScan far = laser.look({home.position + 0.5 * towards, 0.0}, 1.0, rng);
    EXPECT_GT(contradiction(first, home, far, home), 0.1) << turn;
  }
}

}  // namespace
}  // namespace outrider
