#include "outrider/jobs/guard/run/run.hpp"

#include <gtest/gtest.h>

#include <map>

#include "support/guard_runs.hpp"
#include "support/logged_targets.hpp"
#include "support/random_cases.hpp"
#include "support/run_bytes.hpp"

namespace outrider {
namespace {

using testing::cases;
using testing::quick;
using testing::random_guard_problem;
using testing::run_yard;
using testing::YardRun;

TEST(RunGuard, WithoutErrorsTakesWhatThePlanSays) {
  Rng rng(121);
  for (int i = 0; i < cases(8); ++i) {
    auto problem = random_guard_problem(rng, 10, 4, 2.5);
    problem.errors = {0.0, 0.0, {0.0, 0.0}};
    const YardRun done = run_yard(problem, quick(), 1);
    EXPECT_NEAR(metric(done.run, "mission_s"), done.plan.cost_s, 1e-6);
    EXPECT_EQ(metric(done.run, "planned_s"), done.plan.cost_s);
    EXPECT_EQ(metric(done.run, "failed"), 0.0);
    EXPECT_EQ(metric(done.run, "shots"), metric(done.run, "reached"));
  }
}

TEST(RunGuard, CountsEveryTargetOnceAndReplays) {
  Rng rng(122);
  for (int i = 0; i < cases(5); ++i) {
    auto problem = random_guard_problem(rng, 10, 5, 2.5);
    if (i % 2 == 0) problem.targets[1].base.z = 8.0;
    YardRun done = run_yard(problem, quick(), static_cast<std::uint64_t>(i));
    const auto& run = done.run;
    const auto targets = testing::targets_of(run.log);
    const auto& shots = testing::shots_of(run.log);
    std::map<std::string, double> statuses;
    for (const auto& target : targets) statuses[target.status] += 1.0;
    EXPECT_EQ(metric(run, "targets"), 5.0);
    for (const std::string status : {"reached", "failed", "unreachable"}) {
      EXPECT_EQ(metric(run, status), statuses[status]) << status;
    }
    EXPECT_EQ(statuses["reached"] + statuses["failed"] + statuses["unreachable"], 5.0);
    EXPECT_EQ(run.report.status == "done", statuses["failed"] == 0.0);
    EXPECT_EQ(run.report.reason.empty(), statuses["reached"] == 5.0);
    EXPECT_EQ(metric(run, "shots"), static_cast<double>(shots.size()));
    for (const auto& target : targets) {
      const bool hit = std::ranges::any_of(shots, [&](const auto& s) {
        return s.message.target == target.name && s.message.hit && s.message.contact == target.name;
      });
      EXPECT_EQ(hit, target.status == "reached") << target.name;
      EXPECT_FALSE(target.reason.empty());
    }
    // The clock never runs back, and the mission ends with its last sample.
    EXPECT_TRUE(testing::stamps_are_sorted(run.log));
    EXPECT_EQ(nanoseconds(metric(run, "mission_s")), nanoseconds(testing::track_of(run.log).back().time_s));
    double driven = 0.0;
    for (const auto& path : testing::driven_paths(run.log)) {
      for (std::size_t k = 1; k < path.size(); ++k) driven += distance(path[k - 1], path[k]);
    }
    EXPECT_NEAR(metric(run, "driven_m"), driven, 1e-9);
    EXPECT_EQ(test::bytes_of_run(done.run),
              test::bytes_of_run(run_yard(problem, quick(), static_cast<std::uint64_t>(i)).run));
  }
}

TEST(RunGuard, IsOverAtOnceWithoutTargets) {
  Rng rng(123);
  const YardRun done = run_yard(random_guard_problem(rng, 4, 0, 2.0), quick(), 1);
  EXPECT_EQ(done.run.report.status, "done");
  EXPECT_EQ(metric(done.run, "mission_s"), 0.0);
  EXPECT_TRUE(testing::shots_of(done.run.log).empty());
}

}  // namespace
}  // namespace outrider
