#include "outrider/jobs/explore/run.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "box_solid.hpp"
#include "outrider/log/append.hpp"
#include "outrider/log/messages/motion_messages.hpp"
#include "outrider/log/messages/ros_sensor_messages.hpp"
#include "outrider/log/topics.hpp"
#include "support/run_bytes.hpp"

namespace outrider {
namespace {

/// A room of 3 m x 2 m with a screen in it.
World room_with_screen() {
  World world;
  world.name = "room";
  world.solids = {testing::box("south", {-0.1, -0.1}, {3.1, 0.0}),
                  testing::box("north", {-0.1, 2.0}, {3.1, 2.1}),
                  testing::box("west", {-0.1, 0.0}, {0.0, 2.0}), testing::box("east", {3.0, 0.0}, {3.1, 2.0}),
                  testing::box("screen", {1.5, 0.0}, {1.6, 1.3})};
  world.bounds = {{-0.1, -0.1}, {3.1, 2.1}};
  return world;
}

ExploreTask task_at(Pose2 start) {
  ExploreTask task;
  task.start = start;
  return task;
}

TEST(ExploreRun, MapsARoomWithItsOwnIdeaOfWhereItIs) {
  Log log;
  const auto run = run_explore(room_with_screen(), task_at({{0.5, 0.5}, 1.0}), {}, 3, log);
  ASSERT_TRUE(run) << run.error().sentence;
  EXPECT_EQ(run->report.status, "done") << run->report.reason;
  EXPECT_EQ(run->stop_reason, "complete");
  EXPECT_GE(metric(run->report, "explored_fraction"), 0.99);
  EXPECT_LE(metric(run->report, "map_error_m"), 0.05);
  EXPECT_EQ(metric(run->report, "contacts"), 0.0);
  EXPECT_EQ(metric(run->report, "returned_home"), 1.0);
  EXPECT_GT(metric(run->report, "max_decision_s"), 0.0);
  EXPECT_GE(metric(run->report, "max_step_s"), metric(run->report, "max_decision_s"));
  EXPECT_LT(distance(run->pose.position, run->true_pose.position), 0.05);
  ASSERT_FALSE(poses_of(log).empty());
  EXPECT_LT(distance(poses_of(log).back().position, run->true_pose.position), 1e-9);
  EXPECT_FALSE(log.messages<geometry_msgs::PoseWithCovarianceStamped>(topic::belief).empty());
  ASSERT_FALSE(log.messages<outrider_msgs::Decision>(topic::decisions).empty());
  for (const auto& [time_ns, decision] : log.messages<outrider_msgs::Decision>(topic::decisions)) {
    EXPECT_EQ(decision.candidates.empty(), decision.kind == "home");
    EXPECT_LE(decision.candidates.size(), 16U);
    for (std::size_t i = 0; i < decision.candidates.size(); ++i) {
      const outrider_msgs::Candidate& one = decision.candidates[i];
      EXPECT_EQ(one.chosen, i == 0) << "the best is chosen, and comes first";
      EXPECT_FALSE(one.value < decision.candidates[0].value) << decision.value_of;
      EXPECT_GT(one.gain, 0.0);
    }
  }
  EXPECT_EQ(log.latest<outrider_msgs::Solids>(topic::solids)->solids.size(), 5U);
  const auto* scan = log.latest<sensor_msgs::LaserScan>(topic::scan);
  ASSERT_NE(scan, nullptr);
  EXPECT_EQ(scan->range_max, static_cast<float>(RangeFinderModel{}.most_m));
}

TEST(ExploreRun, SaysTheSameTwiceWhoeverLooksOn) {
  Log log, watched;
  const auto one = run_explore(room_with_screen(), task_at({{0.5, 0.5}, 1.0}), {}, 4, log);
  int scans = 0;
  double part = 0.0;
  RunWatch watch;
  watch.progress = [&](const RunStep& step) { part = std::max(part, step.part); };
  test::LogRecorder recorder;
  watched.add_sink(recorder);
  const auto two =
      run_explore(room_with_screen(), task_at({{0.5, 0.5}, 1.0}), {}, 4, watched, watch,
                  [&](const Observation&, const ExploreMission&, const SimulatedRobot&) { ++scans; });
  ASSERT_TRUE(one && two);
  watched.remove_sink(recorder);
  EXPECT_EQ(one->map.cells, two->map.cells);
  outrider::Run first{one->report, std::move(log)}, second{two->report, std::move(watched)};
  EXPECT_EQ(test::bytes_of_run(first), test::bytes_of_run(second));
  EXPECT_EQ(recorder.finish(), test::bytes_of_log(first.log));
  EXPECT_EQ(static_cast<std::size_t>(scans) + 1, two->track.size());
  EXPECT_GT(part, 0.3);
}

TEST(ExploreRun, StopsWhenToldAndKeepsWhatItHas) {
  std::stop_source source;
  RunWatch watch;
  watch.stop = source.get_token();
  int scans = 0;
  Log log;
  const auto run = run_explore(room_with_screen(), task_at({{0.5, 0.5}, 1.0}), {}, 4, log, watch,
                               [&](const Observation&, const ExploreMission&, const SimulatedRobot&) {
                                 if (++scans == 20) source.request_stop();
                               });
  ASSERT_TRUE(run);
  EXPECT_EQ(run->report.status, "cancelled");
  EXPECT_NE(run->report.reason.find("cancelled after"), std::string::npos) << run->report.reason;
  EXPECT_EQ(scans, 20);
  EXPECT_GT(metric(run->report, "explored_fraction"), 0.0);
}

TEST(ExploreRun, TurnsBackSoonWhereTheWorldHasNoEndAndNamesTheGap) {
  World open = room_with_screen();
  open.solids[3] = testing::box("east", {3.0, 0.0}, {3.1, 1.0});  // of the wall to 2.0
  Log log;
  const auto run = run_explore(open, task_at({{0.5, 0.5}, 1.0}), {}, 3, log);
  ASSERT_TRUE(run) << run.error().sentence;
  EXPECT_EQ(run->stop_reason, "leak");
  EXPECT_EQ(run->report.status, "not_done");
  EXPECT_NE(run->report.reason.find("at about 3.1"), std::string::npos) << run->report.reason;
  EXPECT_EQ(metric(run->report, "returned_home"), 1.0);
  EXPECT_LT(metric(run->report, "time_s"), 300.0);
}

/// A yard of 4 m x 4 m with a crate in it.
World yard_with_crate() {
  World world;
  world.name = "yard";
  world.solids = {
      testing::box("south", {-2.1, -2.1}, {2.1, -1.9}), testing::box("north", {-2.1, 1.9}, {2.1, 2.1}),
      testing::box("west", {-2.1, -2.0}, {-1.9, 2.0}), testing::box("east", {1.9, -2.0}, {2.1, 2.0}),
      testing::box("crate", {0.5, 0.5}, {1.0, 1.0})};
  world.bounds = {{-2.1, -2.1}, {2.1, 2.1}};
  return world;
}

TEST(ExploreRun, EndsOnCellsThatAreTooLargeAndWhereWallsHardlyCount) {
  for (const auto& [resolution_m, occupied_above] : {std::pair{1.0, 0.0}, {3.0, 0.0}, {0.05, 3.49}}) {
    ExploreTask task = task_at({{0.0, -1.2}, pi / 2.0});
    task.slam.map.resolution_m = resolution_m;
    task.slam.map.occupied_above = occupied_above;
    Log log;
    const auto run = run_explore(yard_with_crate(), task, {}, 1, log);
    ASSERT_TRUE(run) << run.error().sentence;
    EXPECT_TRUE(run->report.status == "not_done" || metric(run->report, "explored_fraction") > 0.98)
        << resolution_m << " " << occupied_above;
    EXPECT_LT(metric(run->report, "time_s"), 1000.0)
        << "of a mission of at most " << task.rules.most_time_s << " s";
  }
}

TEST(ExploreRun, RefusesAStartInsideAWall) {
  Log log;
  const auto run = run_explore(room_with_screen(), task_at({{1.55, 0.5}, 0.0}), {}, 1, log);
  ASSERT_FALSE(run);
  EXPECT_EQ(run.error().code, FaultCode::start_blocked);
}

}  // namespace
}  // namespace outrider
