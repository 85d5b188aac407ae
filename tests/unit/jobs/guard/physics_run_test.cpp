#include "outrider/jobs/guard/run.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "outrider/core/rng.hpp"
#include "outrider/jobs/guard/rigid_world.hpp"
#include "outrider/report/json.hpp"
#include "support/curious.hpp"
#include "support/guard_yard.hpp"
#include "support/paged.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

using testing::box_at;
using testing::cases;
using testing::quick;

class RunGuardInPhysics : public ::testing::Test {
 protected:
  void SetUp() override {
    Rng rng(620);
    const auto ok = make_rigid_world(testing::random_guard_problem(rng, 0, 1, 2.5));
    if (!ok) GTEST_SKIP() << ok.error().sentence;
  }

  static PageReport run(const GuardProblem& problem, std::uint64_t seed, LogSink* sink = nullptr) {
    const auto firing_map = build_firing_map(problem, quick());
    EXPECT_TRUE(firing_map.has_value()) << firing_map.error().sentence;
    const auto plan = plan_guard(problem, *firing_map, quick(), {});
    EXPECT_TRUE(plan.has_value());
    double last = 0.0;
    RunWatch watch;
    if (sink != nullptr) watch.sinks = {sink};
    watch.progress = [&](const RunStep& step) {
      EXPECT_GE(step.part, last);
      last = step.part;
    };
    const GuardRun guard{.problem = problem,
                         .firing_map = *firing_map,
                         .plan = *plan,
                         .options = quick(),
                         .seed = seed,
                         .rigid = true};
    auto report = testing::paged(watch, [&](Log& log) { return run_guard(guard, log, watch); });
    EXPECT_TRUE(report.has_value()) << report.error().sentence;
    EXPECT_EQ(last, 1.0);
    return std::move(*report);
  }
};

TEST_F(RunGuardInPhysics, HitsWhatThePlanPromises) {
  Rng rng(621);
  for (int i = 0; i < cases(4); ++i) {
    auto problem = testing::random_guard_problem(rng, 8, 4, 2.5);
    const bool exact = i % 2 == 0;
    if (exact) problem.errors = {0.0, 0.0, {0.0, 0.0}};
    const PageReport report = run(problem, static_cast<std::uint64_t>(i));
    EXPECT_EQ(report.sim, "physics");
    EXPECT_EQ(metric(report, "failed"), 0.0);
    // The wheels take a little longer than the profiles, and come as near as this.
    if (exact) {
      EXPECT_GT(metric(report, "mission_s"), metric(report, "planned_s") - 0.05);
      EXPECT_LT(metric(report, "mission_s"), 1.1 * metric(report, "planned_s") + 1.0);
    }
    EXPECT_LT(metric(report, "arrival_error_max_m"), 0.01);
    EXPECT_LE(metric(report, "arrival_error_mean_m"), metric(report, "arrival_error_max_m"));
    EXPECT_EQ(metric(report, "bumps"), 0.0);
    // Semi-implicit Euler: g h t / 2 below the parabola, with h = 0.25 ms and flights under 2 s.
    EXPECT_LT(metric(report, "flight_error_max_m"), 0.5 * 9.8 * 0.25e-3 * 2.0);
    EXPECT_GE(metric(report, "shots_as_foreseen"), metric(report, "shots") - 1.0);
    for (std::size_t k = 1; k < report.track.size(); ++k) {
      EXPECT_LE(report.track[k - 1].time_s, report.track[k].time_s);
    }
    const auto back = report_from_json(to_json(report));
    ASSERT_TRUE(back.has_value()) << back.error().sentence;
    EXPECT_EQ(to_json(*back), to_json(report));
  }
}

TEST_F(RunGuardInPhysics, GivesTheSameBytesTwice) {
  Rng rng(622);
  const auto problem = testing::random_guard_problem(rng, 8, 4, 2.5);
  const std::string first = to_json(run(problem, 5));
  testing::Curious curious;
  const PageReport again = run(problem, 5, &curious);
  EXPECT_EQ(first, to_json(again));
  curious.expect_to_have_seen(again);
  EXPECT_NE(first, to_json(run(problem, 6)));
}

TEST_F(RunGuardInPhysics, SaysWhatAMissTouchedAndWhere) {
  Rng rng(623);
  auto problem = testing::random_guard_problem(rng, 4, 3, 2.5);
  problem.errors.aim = {0.4, 0.3};
  problem.tries = 2;
  const PageReport report = run(problem, 1);
  int missed = 0;
  for (const ReportShot& shot : report.shots) {
    if (shot.hit) continue;
    ++missed;
    EXPECT_NE(shot.contact, shot.target);
    EXPECT_TRUE(std::ranges::any_of(report.events, [&](const ReportEvent& event) {
      return event.kind == "miss" && event.text.find("misses " + shot.target) == 0 &&
             event.text.find("touches " + shot.contact + " at (") != std::string::npos &&
             event.text.find("m from it") != std::string::npos;
    })) << shot.contact;
  }
  EXPECT_GT(missed, 0);
  for (const ReportTarget& target : report.targets) {
    if (target.status != "failed") continue;
    EXPECT_NE(target.reason.find("; the last shot touches "), std::string::npos) << target.reason;
  }
}

}  // namespace
}  // namespace outrider
