#include "outrider/jobs/guard/run.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "outrider/core/rng.hpp"
#include "outrider/jobs/guard/rigid_world.hpp"
#include "support/guard_yard.hpp"
#include "support/logged_targets.hpp"
#include "support/random_cases.hpp"
#include "support/run_bytes.hpp"

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

  static outrider::Run carry_out(const GuardProblem& problem, std::uint64_t seed, LogSink* sink = nullptr) {
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
    auto run = testing::logged_run(watch, [&](Log& log) { return run_guard(guard, log, watch); });
    EXPECT_TRUE(run.has_value()) << run.error().sentence;
    EXPECT_EQ(last, 1.0);
    return std::move(*run);
  }
};

TEST_F(RunGuardInPhysics, HitsWhatThePlanPromises) {
  Rng rng(621);
  for (int i = 0; i < cases(4); ++i) {
    auto problem = testing::random_guard_problem(rng, 8, 4, 2.5);
    const bool exact = i % 2 == 0;
    if (exact) problem.errors = {0.0, 0.0, {0.0, 0.0}};
    const auto run = carry_out(problem, static_cast<std::uint64_t>(i));
    EXPECT_EQ(run.log.latest<outrider_msgs::RunInfo>(topic::run)->sim, "physics");
    EXPECT_EQ(metric(run, "failed"), 0.0);
    // The wheels take a little longer than the profiles, and come as near as this.
    if (exact) {
      EXPECT_GT(metric(run, "mission_s"), metric(run, "planned_s") - 0.05);
      EXPECT_LT(metric(run, "mission_s"), 1.1 * metric(run, "planned_s") + 1.0);
    }
    EXPECT_LT(metric(run, "arrival_error_max_m"), 0.01);
    EXPECT_LE(metric(run, "arrival_error_mean_m"), metric(run, "arrival_error_max_m"));
    EXPECT_EQ(metric(run, "bumps"), 0.0);
    // Semi-implicit Euler: g h t / 2 below the parabola, with h = 0.25 ms and flights under 2 s.
    EXPECT_LT(metric(run, "flight_error_max_m"), 0.5 * 9.8 * 0.25e-3 * 2.0);
    EXPECT_GE(metric(run, "shots_as_foreseen"), metric(run, "shots") - 1.0);
    EXPECT_TRUE(testing::stamps_are_sorted(run.log));
  }
}

TEST_F(RunGuardInPhysics, GivesTheSameBytesTwice) {
  Rng rng(622);
  const auto problem = testing::random_guard_problem(rng, 8, 4, 2.5);
  const std::string first = test::bytes_of_run(carry_out(problem, 5));
  test::LogRecorder recorder;
  auto again = carry_out(problem, 5, &recorder);
  EXPECT_EQ(first, test::bytes_of_run(again));
  EXPECT_EQ(recorder.finish(), test::bytes_of_log(again.log));
  EXPECT_NE(first, test::bytes_of_run(carry_out(problem, 6)));
}

TEST_F(RunGuardInPhysics, SaysWhatAMissTouchedAndWhere) {
  Rng rng(623);
  auto problem = testing::random_guard_problem(rng, 4, 5, 3.5);
  problem.errors.aim = {0.5, 0.5};
  problem.tries = 2;
  int missed = 0;
  for (std::uint64_t seed = 1; missed == 0 && seed <= 4; ++seed) {
    const auto run = carry_out(problem, seed);
    const auto misses = events_of(run.log, "miss");
    for (const auto& [time_ns, shot] : testing::shots_of(run.log)) {
      if (shot.hit) continue;
      ++missed;
      EXPECT_NE(shot.contact, shot.target);
      EXPECT_TRUE(std::ranges::any_of(misses, [&said = shot](const auto& event) {
        const std::string& text = event.message.msg;
        return text.starts_with("misses " + said.target) &&
               text.find("touches " + said.contact + " at (") != std::string::npos &&
               text.find("m from it") != std::string::npos;
      })) << shot.contact;
    }
    for (const auto& target : testing::targets_of(run.log)) {
      if (target.status != "failed") continue;
      EXPECT_NE(target.reason.find("; the last shot touches "), std::string::npos) << target.reason;
    }
  }
  EXPECT_GT(missed, 0);
}

}  // namespace
}  // namespace outrider
