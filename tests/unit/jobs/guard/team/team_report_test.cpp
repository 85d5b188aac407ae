#include <gtest/gtest.h>

#include <algorithm>

#include "outrider/job/run_job.hpp"
#include "outrider/jobs/guard/job.hpp"
#include "outrider/log/append.hpp"
#include "support/data.hpp"
#include "support/guard_yard.hpp"
#include "team/team_report.hpp"

namespace outrider {
namespace {

/// A yard with one target, which robot 1 has hit, and two robots that drive so.
struct Judged {
  GuardScenario scenario;
  TeamPlan plan;
  TeamRun team;

  Judged() {
    GuardProblem& problem = scenario.problem;
    problem.world.bounds = {{-4, -4}, {4, 4}};
    problem.world.solids = {testing::floor_at(0)};
    problem.start = {{-2, 0}, 0.0};
    problem.targets = {{"cat", {2.0, 2.0, 0.0}, {0.3, 0.3, 0.3}}};
    scenario.options = testing::quick();
    plan.parts.resize(2);
    team.records.resize(1);
    team.records[0].status = TargetStatus::reached;
    team.records[0].reason = "hit";
    team.records[0].done_s = 1.0;
    team.robot_of = {0};
    team.robots.resize(2);
    team.robots[0].driven = {problem.start, {{0.0, {{-2, 0}, {2, 0}}}}};
    team.robots[1].driven = {{{0, -2}, pi / 2}, {}};
  }
  [[nodiscard]] Report report() const {
    const auto firing_map = build_firing_map(scenario.problem, scenario.options);
    return judge_team(scenario, *firing_map, plan, team, Log());
  }
};

TEST(JudgedTeam, IsDoneOnlyIfTheRobotsKeptApart) {
  Judged one;
  const Report apart = one.report();
  EXPECT_EQ(apart.status, "done") << apart.reason;
  EXPECT_EQ(metric(apart, "closest_m"), 2.0);
  one.team.robots[1].driven.drives = {{0.0, {{0, -2}, {0, 2}}}};  // both are in the middle at once
  const Report met = one.report();
  EXPECT_EQ(met.status, "not_done");
  EXPECT_NE(met.reason.find("robots 1 and 2 were 0.00 m apart after"), std::string::npos) << met.reason;
  one.team.robots[1].driven.drives = {{0.0, {{1, 1}, {0, 2}}}};  // not from where it stands
  const Report broken = one.report();
  EXPECT_EQ(broken.status, "not_done");
  EXPECT_NE(broken.reason.find("drive 1 of robot 2 begins elsewhere"), std::string::npos) << broken.reason;
}

TEST(JudgedTeam, IsNotDoneWithATargetThatFailed) {
  Judged one;
  one.team.records[0].status = TargetStatus::failed;
  const Report report = one.report();
  EXPECT_EQ(report.status, "not_done");
  EXPECT_NE(report.reason.find("0 of 1 targets reached"), std::string::npos) << report.reason;
}

/// Whoever stops a run gets what was done so far, and a status that says so.
TEST(GuardWithTeam, StopsWhereItIsAsked) {
  GuardJob job;
  ASSERT_TRUE(read_scenario(job, test::scenarios + "driveby/driveby.yaml"));
  job.scenario.robots = 2;
  job.scenario.options = testing::quick();
  ASSERT_TRUE(job.load());
  std::stop_source stop;
  RunWatch watch;
  watch.stop = stop.get_token();
  double part = 0.0;
  watch.progress = [&](const RunStep& step) {
    if (step.number == 3 && step.part > 0.3) stop.request_stop();
    if (step.number == 3) part = step.part;
  };
  outrider::Run run;
  ASSERT_TRUE(job.run(run, watch));
  EXPECT_EQ(run.report.status, "cancelled");
  EXPECT_LT(part, 1.0);
  EXPECT_EQ(events_of(run.log, "cancelled").size(), 1U);
  const Table& targets = table_named(run.report, "targets");
  const auto is_waiting = [&](const auto& row) { return TableRow{targets, row}.text("status") == "waiting"; };
  EXPECT_TRUE(std::ranges::any_of(targets.rows, is_waiting));
  EXPECT_GT(metric(run.report, "reached"), 0.0);
}

}  // namespace
}  // namespace outrider
