#include "outrider/jobs/guard/run.hpp"

#include <gtest/gtest.h>

#include <map>

#include "outrider/report/json.hpp"
#include "support/guard_runs.hpp"
#include "support/guard_yard.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

using testing::cases;
using testing::quick;
using testing::random_guard_problem;

struct Mission {
  GuardProblem problem;
  GuardPlan plan;
  PageReport report;
};

Mission carried_out(GuardProblem problem, std::uint64_t seed) {
  const auto firing_map = build_firing_map(problem, quick());
  EXPECT_TRUE(firing_map.has_value()) << firing_map.error().sentence;
  auto plan = plan_guard(problem, *firing_map, quick(), {});
  EXPECT_TRUE(plan.has_value());
  PageReport report = testing::run_still(problem, *firing_map, *plan, quick(), seed);
  return {std::move(problem), std::move(*plan), std::move(report)};
}

TEST(RunGuard, WithoutErrorsTakesWhatThePlanSays) {
  Rng rng(121);
  for (int i = 0; i < cases(8); ++i) {
    auto problem = random_guard_problem(rng, 10, 4, 2.5);
    problem.errors = {0.0, 0.0, {0.0, 0.0}};
    const Mission done = carried_out(problem, 1);
    EXPECT_NEAR(metric(done.report, "mission_s"), done.plan.cost_s, 1e-6);
    EXPECT_EQ(metric(done.report, "planned_s"), done.plan.cost_s);
    EXPECT_EQ(metric(done.report, "failed"), 0.0);
    EXPECT_EQ(metric(done.report, "shots"), metric(done.report, "reached"));
  }
}

TEST(RunGuard, CountsEveryTargetOnceAndReplays) {
  Rng rng(122);
  for (int i = 0; i < cases(5); ++i) {
    auto problem = random_guard_problem(rng, 10, 5, 2.5);
    if (i % 2 == 0) problem.targets[1].base.z = 8.0;
    const Mission done = carried_out(problem, static_cast<std::uint64_t>(i));
    const PageReport& report = done.report;
    std::map<std::string, double> statuses;
    for (const ReportTarget& target : report.targets) statuses[target.status] += 1.0;
    EXPECT_EQ(metric(report, "targets"), 5.0);
    for (const std::string status : {"reached", "failed", "unreachable"}) {
      EXPECT_EQ(metric(report, status), statuses[status]) << status;
    }
    EXPECT_EQ(statuses["reached"] + statuses["failed"] + statuses["unreachable"], 5.0);
    EXPECT_EQ(report.status == "done", statuses["failed"] == 0.0);
    EXPECT_EQ(report.reason.empty(), statuses["reached"] == 5.0);
    EXPECT_EQ(metric(report, "shots"), static_cast<double>(report.shots.size()));
    for (const ReportTarget& target : report.targets) {
      const bool hit = std::any_of(report.shots.begin(), report.shots.end(), [&](const ReportShot& s) {
        return s.target == target.name && s.hit && s.contact == target.name;
      });
      EXPECT_EQ(hit, target.status == "reached") << target.name;
      EXPECT_FALSE(target.reason.empty());
    }
    // The clock never runs back, and the mission ends with its last sample.
    for (std::size_t k = 1; k < report.track.size(); ++k) {
      EXPECT_GE(report.track[k].time_s, report.track[k - 1].time_s);
    }
    EXPECT_EQ(nanoseconds(metric(report, "mission_s")), nanoseconds(report.track.back().time_s));
    double driven = 0.0;
    for (const ReportPath& path : report.paths) {
      for (std::size_t k = 1; k < path.waypoints.size(); ++k) {
        driven += distance(path.waypoints[k - 1], path.waypoints[k]);
      }
    }
    EXPECT_NEAR(metric(report, "driven_m"), driven, 1e-9);
    EXPECT_EQ(to_json(report), to_json(carried_out(problem, static_cast<std::uint64_t>(i)).report));
  }
}

TEST(RunGuard, IsOverAtOnceWithoutTargets) {
  Rng rng(123);
  const Mission done = carried_out(random_guard_problem(rng, 4, 0, 2.0), 1);
  EXPECT_EQ(done.report.status, "done");
  EXPECT_EQ(metric(done.report, "mission_s"), 0.0);
  EXPECT_TRUE(done.report.shots.empty());
}

}  // namespace
}  // namespace outrider
