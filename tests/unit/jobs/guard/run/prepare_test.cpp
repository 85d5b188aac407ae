#include "outrider/jobs/guard/run/prepare.hpp"

#include <gtest/gtest.h>

#include "outrider/job/run_job.hpp"
#include "outrider/jobs/guard/job.hpp"
#include "outrider/jobs/guard/run/robot.hpp"
#include "support/data.hpp"
#include "support/logged_run.hpp"

namespace outrider {
namespace {

/// A task of the job, read and loaded.
GuardJob& loaded(GuardJob& task, const std::string& scenario, const Changes& changes) {
  EXPECT_TRUE(read_scenario(task, test::scenarios + scenario));
  EXPECT_TRUE(change(task, changes));
  EXPECT_TRUE(task.load());
  return task;
}

TargetSimParams params_of(const PreparedGuard& guard) {
  const GuardScenario& scenario = guard.scenario;
  TargetSimParams params;
  if (guard.yard) params.intruders = guard.yard->intruders;
  params.survival = {scenario.arrivals.leave, scenario.arrivals.walk_mps};
  if (guard.walkers) {
    const auto walks = draw_walks(scenario.problem, guard.plan->firing_map, scenario.preferences,
                                  scenario.wander, static_cast<std::uint64_t>(scenario.seed), 7200.0);
    params.walks = walks.value();
    params.look_s = scenario.wander.look_s;
    params.sight_m = scenario.wander.sight_m;
  }
  return params;
}

struct PreparedCase {
  std::string scenario;
  Changes changes = {};
};

class Prepared : public ::testing::TestWithParam<PreparedCase> {};

/// The mission that any robot may carry out is the one that the job simulates.
TEST_P(Prepared, IsTheMissionOfTheJob) {
  const std::string& scenario = GetParam().scenario;
  Changes changes = {{"plan.resolution", "0.4"}, {"plan.gap", "1"}};
  changes.insert(changes.end(), GetParam().changes.begin(), GetParam().changes.end());
  GuardJob job;
  outrider::Run run;
  ASSERT_TRUE(loaded(job, scenario, changes).run(run, {}));

  GuardJob same;
  auto guard = prepare_guard(loaded(same, scenario, changes).scenario);
  ASSERT_TRUE(guard) << guard.error().sentence;
  GuardMission& mission = *(*guard)->mission;
  Log log;
  SimulatedRobot robot = simulated_guard(mission.board().problem(), (*guard)->plan->firing_map, log,
                                         static_cast<std::uint64_t>(job.scenario.seed), params_of(**guard));
  double end_s = 0.0;
  EXPECT_TRUE(
      run_mission(mission, robot, {}, [&](const Observation& seen, const Command*) { end_s = seen.time_s; }));
  EXPECT_EQ(end_s, metric(run, "mission_s"));
  EXPECT_EQ(verdict_of(mission).status, run.report.status);
  EXPECT_EQ(verdict_of(mission).reason.empty(), run.report.reason.empty());
  double reached = 0.0;
  for (const TargetRecord& record : mission.board().records())
    reached += record.status == TargetStatus::reached ? 1.0 : 0.0;
  EXPECT_EQ(reached, metric(run, "reached"));
}

INSTANTIATE_TEST_SUITE_P(Scenarios, Prepared,
                         ::testing::Values(PreparedCase{"driveby/driveby.yaml"},
                                           PreparedCase{"survivors/survivors.yaml"},
                                           PreparedCase{"wander/wander.yaml"},
                                           PreparedCase{"survivors/survivors.yaml",
                                                        {{"arrivals.leave", "1"},
                                                         {"arrivals.count", "4"},
                                                         {"arrivals.entrances", "gate=0,-6.9"}}},
                                           PreparedCase{"driveby/driveby.yaml",
                                                        {{"plan.shoot_on_the_move", "false"},
                                                         {"supplies.tank", "2"},
                                                         {"supplies.stations", "well=-11,0,water"}}}));

TEST(PrepareGuard, RefusesWhatIsNoMissionOfAKnownYard) {
  for (const auto& [key, value] : {std::pair{"scout.unknown", "true"}, {"robots", "2"}}) {
    GuardJob task;
    const auto guard = prepare_guard(
        loaded(task, "driveby/driveby.yaml", {{"plan.shoot_on_the_move", "false"}, {key, value}}).scenario);
    ASSERT_FALSE(guard);
    EXPECT_EQ(guard.error().code, FaultCode::bad_input);
  }
}

TEST(PrepareGuard, StopsWhenAsked) {
  GuardJob task;
  std::stop_source stop;
  stop.request_stop();
  RunWatch watch;
  watch.stop = stop.get_token();
  const auto guard = prepare_guard(loaded(task, "survivors/survivors.yaml", {}).scenario, watch);
  ASSERT_FALSE(guard);
  EXPECT_EQ(guard.error().code, FaultCode::cancelled);
}

}  // namespace
}  // namespace outrider
