#include "outrider/jobs/guard/run/scout_run.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "outrider/jobs/guard/job.hpp"
#include "outrider/log/messages/ros_messages.hpp"
#include "support/logged_targets.hpp"
#include "support/run_bytes.hpp"

namespace outrider {
namespace {

Solid box(std::string name, Vec2 low, Vec2 high) {
  const Vec2 middle = 0.5 * (low + high), half = 0.5 * (high - low);
  return {std::move(name), {{middle.x, middle.y, 0.5}, {}}, BoxShape{{half.x, half.y, 0.5}}};
}

/// A room of 5 x 4 m with a hedge in it and a closet that is shut; a target behind each and one in the open.
GuardProblem room_with_closet() {
  GuardProblem problem;
  problem.world.name = "room";
  problem.world.solids = {box("south", {-0.1, -0.1}, {5.1, 0}), box("north", {-0.1, 4}, {5.1, 4.1}),
                          box("west", {-0.1, 0}, {0, 4}),       box("east", {5, 0}, {5.1, 4}),
                          box("hedge", {1.5, 2.2}, {3.5, 2.4}), box("closet", {4.2, 0}, {4.25, 1}),
                          box("door", {4.2, 1}, {5, 1.05})};
  problem.world.bounds = {{0, 0}, {5, 4}};
  problem.start = {{1.0, 1.0}, 0.0};
  problem.errors.position_m = 0.02;
  problem.targets = {{"open", {3.0, 0.6, 0.0}, {0.3, 0.3, 0.3}},
                     {"shut in", {4.7, 0.5, 0.0}, {0.3, 0.3, 0.3}},
                     {"hidden", {2.5, 3.2, 0.0}, {0.3, 0.3, 0.3}}};
  return problem;
}

Outcome<outrider::Run> mission(std::uint64_t seed, LogSink* sink = nullptr) {
  GuardJob job;
  job.scenario.problem = room_with_closet();
  job.scenario.options.shoot_on_the_move = false;
  job.scenario.options.resolution_m = 0.25;
  job.scenario.scout.unknown = true;
  job.scenario.seed = static_cast<std::int64_t>(seed);
  Run run;
  if (sink != nullptr) run.log.add_sink(*sink);
  if (auto ok = job.run(run, {}); !ok) return pass_on(ok);
  if (sink != nullptr) run.log.remove_sink(*sink);
  return run;
}

TEST(ScoutRun, HitsWhomItSawOnTheMapItMade) {
  const auto run = mission(1);
  ASSERT_TRUE(run) << to_string(run.error());
  const Table& targets = table_named(run->report, "targets");
  ASSERT_EQ(targets.rows.size(), 3U);
  const auto target = [&](std::size_t i) { return TableRow{targets, targets.rows[i]}; };
  EXPECT_EQ(target(0).text("name"), "open");
  EXPECT_EQ(target(0).text("status"), "reached") << target(0).text("reason");
  EXPECT_EQ(target(1).text("status"), "failed");
  EXPECT_EQ(target(1).text("reason"), "not seen while exploring");
  EXPECT_EQ(target(2).text("status"), "reached") << target(2).text("reason");
  const auto logged = testing::targets_of(run->log);
  ASSERT_EQ(logged.size(), 3U);
  for (const auto& one : logged) {
    EXPECT_EQ(one.status, one.name == "shut in" ? "failed" : "reached") << one.name;
  }
  EXPECT_EQ(run->report.status, "not_done");
  EXPECT_EQ(metric(*run, "seen"), 2.0);
  EXPECT_EQ(metric(*run, "contacts"), 0.0);
  EXPECT_GT(metric(*run, "explored_fraction"), 0.97);
  const double explore_s = metric(*run, "explore_s");
  ASSERT_FALSE(testing::shots_of(run->log).empty());
  for (const auto& shot : testing::shots_of(run->log)) EXPECT_GT(shot.time_s(), explore_s);
  EXPECT_TRUE(testing::stamps_are_sorted(run->log));
  EXPECT_EQ(events_of(run->log, "seen").size(), 2U);
  EXPECT_NEAR(metric(*run, "mission_s"), testing::track_of(run->log).back().time_s, 1e-9);
  const auto* map = run->log.latest<nav_msgs::OccupancyGrid>(topic::map);
  ASSERT_NE(map, nullptr);
  EXPECT_GT(map->info.width, 80U);
}

TEST(ScoutRun, IsTheSameForTheSameSeed) {
  test::LogRecorder recorder;
  auto once = mission(2), again = mission(2, &recorder);
  ASSERT_TRUE(once && again);
  EXPECT_EQ(test::bytes_of_run(*once), test::bytes_of_run(*again));
  EXPECT_EQ(recorder.finish(), test::bytes_of_log(once->log));
}

}  // namespace
}  // namespace outrider
