#include "outrider/jobs/guard/scout_run.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "outrider/jobs/guard/plan.hpp"
#include "outrider/report/json.hpp"
#include "support/curious.hpp"
#include "support/paged.hpp"

namespace outrider {
namespace {

Solid box(std::string name, Vec2 low, Vec2 high) {
  const Vec2 middle = 0.5 * (low + high), half = 0.5 * (high - low);
  return {std::move(name), {{middle.x, middle.y, 0.5}, {}}, BoxShape{{half.x, half.y, 0.5}}};
}

/// A room of 5 x 4 m with a hedge in it and a closet that is shut; a target behind each and one in the open.
GuardProblem yard() {
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

struct Done {
  Report report;
  PageReport page;
};

Outcome<Done> mission(std::uint64_t seed, LogSink* sink = nullptr) {
  const GuardProblem problem = yard();
  GuardOptions options;
  options.resolution_m = 0.25;
  ScoutTask task;
  task.options.unknown = true;
  Log log;
  if (sink != nullptr) log.add_sink(*sink);
  auto found = scout(problem, task, seed, log);
  if (!found) return pass_on(found);
  const auto firing_map = build_firing_map(found->found.problem, options);
  if (!firing_map) return tl::unexpected<Fault>(firing_map.error());
  const auto plan = plan_guard(found->found.problem, *firing_map, options, {});
  if (!plan) return tl::unexpected<Fault>(plan.error());
  auto report = run_guard_on_map(problem, *found, *firing_map, *plan, options, seed, log);
  if (!report) return pass_on(report);
  PageReport page = page_report(*report, log);
  return Done{std::move(*report), std::move(page)};
}

TEST(ScoutRun, HitsWhomItSawOnTheMapItMade) {
  const auto done = mission(1);
  ASSERT_TRUE(done) << to_string(done.error());
  const PageReport* const report = &done->page;
  const Table& targets = table_named(done->report, "targets");
  ASSERT_EQ(targets.rows.size(), 3U);
  const auto target = [&](std::size_t i) { return TableRow{targets, targets.rows[i]}; };
  EXPECT_EQ(target(0).text("name"), "open");
  EXPECT_EQ(target(0).text("status"), "reached") << target(0).text("reason");
  EXPECT_EQ(target(1).text("status"), "failed");
  EXPECT_EQ(target(1).text("reason"), "not seen while exploring");
  EXPECT_EQ(target(2).text("status"), "reached") << target(2).text("reason");
  ASSERT_EQ(report->targets.size(), 3U);
  for (const ReportTarget& one : report->targets) {
    EXPECT_EQ(one.status, one.name == "shut in" ? "failed" : "reached") << one.name;
  }
  EXPECT_EQ(report->status, "not_done");
  EXPECT_EQ(metric(*report, "seen"), 2.0);
  EXPECT_EQ(metric(*report, "contacts"), 0.0);
  EXPECT_GT(metric(*report, "explored_fraction"), 0.97);
  const double explore_s = metric(*report, "explore_s");
  ASSERT_FALSE(report->shots.empty());
  for (const ReportShot& shot : report->shots) EXPECT_GT(shot.time_s, explore_s);
  EXPECT_TRUE(std::ranges::is_sorted(report->track, {}, &TrackSample::time_s));
  EXPECT_TRUE(std::ranges::is_sorted(report->events, {}, &ReportEvent::time_s));
  EXPECT_EQ(std::ranges::count(report->events, "seen", &ReportEvent::kind), 2);
  EXPECT_NEAR(metric(*report, "mission_s"), report->track.back().time_s, 1e-9);
  ASSERT_TRUE(report->explore);
  EXPECT_GT(report->explore->map.columns, 80);
}

TEST(ScoutRun, IsTheSameForTheSameSeed) {
  testing::Curious curious;
  const auto once = mission(2), again = mission(2, &curious);
  ASSERT_TRUE(once && again);
  EXPECT_EQ(to_json(once->page), to_json(again->page));
  curious.expect_to_have_seen(once->page);
}

}  // namespace
}  // namespace outrider
