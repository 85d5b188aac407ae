#include "outrider/jobs/guard/scout_run.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "outrider/jobs/guard/plan.hpp"
#include "outrider/report/json.hpp"
#include "support/curious.hpp"

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

Outcome<Report> mission(std::uint64_t seed, RunObserver* observer = nullptr) {
  const GuardProblem problem = yard();
  GuardOptions options;
  options.resolution_m = 0.25;
  ScoutTask task;
  task.options.unknown = true;
  const RunWatch watch{.observer = observer};
  auto found = scout(problem, task, seed, watch);
  if (!found) return pass_on(found);
  const auto firing_map = build_firing_map(found->found.problem, options);
  if (!firing_map) return tl::unexpected<Fault>(firing_map.error());
  const auto plan = plan_guard(found->found.problem, *firing_map, options, {});
  if (!plan) return tl::unexpected<Fault>(plan.error());
  return run_guard_on_map(problem, std::move(*found), *firing_map, *plan, options, seed, watch);
}

TEST(ScoutRun, HitsWhomItSawOnTheMapItMade) {
  const auto report = mission(1);
  ASSERT_TRUE(report) << to_string(report.error());
  ASSERT_EQ(report->targets.size(), 3U);
  EXPECT_EQ(report->targets[0].status, "reached") << report->targets[0].reason;
  EXPECT_EQ(report->targets[1].status, "failed");
  EXPECT_EQ(report->targets[1].reason, "not seen while exploring");
  EXPECT_EQ(report->targets[2].status, "reached") << report->targets[2].reason;
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
  EXPECT_EQ(to_json(*once), to_json(*again));
  curious.expect_to_have_seen(*once);
}

}  // namespace
}  // namespace outrider
