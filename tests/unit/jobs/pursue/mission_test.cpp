#include "outrider/jobs/pursue/mission.hpp"

#include <gtest/gtest.h>

#include "outrider/sim/simulated_team.hpp"
#include "support/pursuit_oracle.hpp"
#include "support/smooth_pursuit.hpp"

namespace outrider {
namespace {

/// Every lap takes as long.
struct SteadyWatch final : StopWatch {
  double lap_s() override { return each_s; }
  void restart() override { ++restarts; }
  double each_s = 0.0;
  int restarts = 0;
};

/// The cells to which the robot is commanded.
std::vector<Cell> commanded(PursuitMission& mission, const PursuitProblem& problem) {
  SimulatedTeam team({problem.start}, problem.target);
  std::vector<Cell> cells;
  run_mission(mission, team, {}, [&](const Observation&, const Command* command) {
    if (command != nullptr) cells.push_back(std::get<StepToCell>(*command).cell);
  });
  return cells;
}

PursuitProblem corridor() {
  return testing::drawn_pursuit({"11111"}, {0, 0}, std::vector<Cell>(12, Cell{4, 0}));
}

TEST(PursuitMission, FreePlanningGoesAtOnce) {
  const PursuitRules rules;
  SteadyWatch watch;
  PursuitMission mission(corridor(), 12, rules, watch);
  EXPECT_EQ(commanded(mission, corridor()), (std::vector<Cell>{{1, 0}, {2, 0}, {3, 0}, {4, 0}}));
  EXPECT_TRUE(mission.run.state.caught);
  EXPECT_EQ(watch.restarts, 5) << "what passes between two steps is not charged";
}

TEST(PursuitMission, TheRobotWaitsWhileItsFirstAnswerIsThoughtOf) {
  PursuitRules rules;
  rules.clock = PursuitClock::wall;
  SteadyWatch watch;
  watch.each_s = 3.5;
  PursuitMission mission(corridor(), 12, rules, watch);
  const std::vector<Cell> cells = commanded(mission, corridor());
  ASSERT_GE(cells.size(), 2U);
  EXPECT_EQ(cells[0], (Cell{0, 0}));
  EXPECT_EQ(cells[1], (Cell{0, 0}));
  EXPECT_TRUE(mission.run.state.caught);
  EXPECT_EQ(mission.run.state.time_s, static_cast<int>(cells.size()));
}

TEST(PursuitMission, TheSearchIsKeptFromCallToCallWhileTheRobotGoesOn) {
  int most_calls = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    testing::SmoothPursuit of;
    of.side = 50;
    of.seconds = 900;
    of.seed = seed;
    const PursuitProblem problem = testing::smooth_pursuit(of);
    AnytimePursuit whole(problem);
    while (!whole.proven()) ASSERT_TRUE(whole.improve(Budget{}));

    PursuitRules rules;
    rules.clock = PursuitClock::wall;
    rules.budget.expansions = 2'800;  // of each call: enough for a first catch
    SteadyWatch watch;
    watch.each_s = 1.6;
    PursuitMission mission(problem, problem.target.size(), rules, watch);
    (void)commanded(mission, problem);
    EXPECT_TRUE(mission.run.state.caught);
    most_calls = std::max(most_calls, mission.run.calls);
    EXPECT_LE(mission.run.expansions, whole.counters().expansions * 3 / 2) << "it began again";
  }
  EXPECT_GT(most_calls, 2) << "it is no test if one call is enough";
}

TEST(PursuitMission, AFaultOfTheFirstCallEndsItWithoutACommand) {
  const auto problem = testing::drawn_pursuit({"1#1"}, {0, 0}, std::vector<Cell>(3, Cell{2, 0}));
  const PursuitRules rules;
  SteadyWatch watch;
  PursuitMission mission(problem, 3, rules, watch);
  EXPECT_TRUE(commanded(mission, problem).empty());
  ASSERT_TRUE(mission.fault);
  EXPECT_EQ(mission.fault->code, FaultCode::no_path);
}

}  // namespace
}  // namespace outrider
