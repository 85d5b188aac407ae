#include "outrider/jobs/pursue/state.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "support/pursuit_oracle.hpp"

namespace outrider {
namespace {

using testing::drawn_pursuit;

PursuitProposal proposal(int start_s, std::vector<Cell> path) {
  PursuitPlan plan;
  plan.path = std::move(path);
  return {0, plan, start_s};
}

std::vector<Cell> standing(Cell cell, std::size_t seconds) { return std::vector<Cell>(seconds, cell); }

/// A second in which the robot on duty goes on.
void pass_second(PursuitState& state, const PursuitProblem& problem) {
  if (is_over(state, problem)) return;
  std::vector<Cell> robots = state.robots;
  robots[state.duty] = robot_at(state, state.duty, 1);
  pass_second(state, *problem.costs, robots, problem.target[static_cast<std::size_t>(state.time_s) + 1]);
}

TEST(PursuitState, CallsCostWholeSeconds) {
  EXPECT_EQ(seconds_charged(0.0), 1);
  EXPECT_EQ(seconds_charged(0.999), 1);
  EXPECT_EQ(seconds_charged(1.0), 1);
  EXPECT_EQ(seconds_charged(1.999), 1);
  EXPECT_EQ(seconds_charged(2.0), 2);
  EXPECT_EQ(seconds_charged(2.999), 2);
  EXPECT_EQ(seconds_charged(3.0), 3);
  EXPECT_EQ(seconds_charged(-1.0), 1);
  EXPECT_EQ(seconds_charged(std::numeric_limits<double>::quiet_NaN()), 1'000'000'000);
}

TEST(PursuitState, ALateAnswerChargesTheCellInWhichTheRobotWaited) {
  const auto problem = drawn_pursuit({"7123"}, {0, 0}, standing({3, 0}, 10));
  PursuitState state = begin_pursuit({{0, 0}});
  // The call takes 3.5 s: two seconds of waiting pass, then the answer, made to begin there, is taken up.
  pass_second(state, problem);
  pass_second(state, problem);
  EXPECT_TRUE(splice(state, problem, proposal(2, {{0, 0}, {1, 0}, {2, 0}, {3, 0}})));
  pass_second(state, problem);
  EXPECT_EQ(state.time_s, 3);
  EXPECT_EQ(state.cost, 21U);
  EXPECT_EQ(state.robots[0], (Cell{1, 0}));
  pass_second(state, problem);
  pass_second(state, problem);
  EXPECT_TRUE(state.caught);
  EXPECT_EQ(state.time_s, 5);
  EXPECT_EQ(state.cost, 21U + 1U + 2U);
  EXPECT_EQ(state.moves, 3);
  pass_second(state, problem);
  EXPECT_EQ(state.time_s, 5);
}

TEST(PursuitState, SecondZeroDoesNotCountAndTheLastOneDoes) {
  const auto together = drawn_pursuit({"11"}, {0, 0}, {{0, 0}});
  PursuitState state = begin_pursuit({{0, 0}});
  EXPECT_FALSE(state.caught);
  EXPECT_TRUE(is_over(state, together));
  const auto last = drawn_pursuit({"11"}, {0, 0}, {{0, 0}, {1, 0}});
  state = begin_pursuit({{0, 0}});
  splice(state, last, proposal(0, {{0, 0}, {1, 0}}));
  pass_second(state, last);
  EXPECT_TRUE(state.caught);
  EXPECT_EQ(state.time_s, 1);
}

TEST(PursuitState, TheRobotGoesOnWhileThePlannerThinks) {
  const auto problem = drawn_pursuit({"11111111"}, {0, 0}, standing({5, 0}, 20));
  PursuitState state = begin_pursuit({{0, 0}});
  state.ahead = {{1, 0}, {2, 0}, {3, 0}, {4, 0}, {5, 0}};
  for (int s = 0; s < 4; ++s) pass_second(state, problem);
  EXPECT_EQ(state.robots[0], (Cell{4, 0}));
  EXPECT_EQ(state.moves, 4);
}

TEST(PursuitState, OnlyWhatIsCheaperAndOnTheWayIsTakenUp) {
  // Over the lower row the way is dearer.
  const auto problem = drawn_pursuit({"11111", "99999"}, {0, 1}, standing({4, 1}, 12));
  PursuitState state = begin_pursuit({{0, 1}});
  const std::vector<Cell> dear = {{0, 1}, {1, 0}, {2, 0}, {3, 0}, {4, 1}};
  const std::vector<Cell> cheap = {{0, 1}, {1, 1}, {2, 1}, {3, 1}, {4, 1}};
  EXPECT_TRUE(splice(state, problem, proposal(0, dear)));
  EXPECT_EQ(cost_ahead(state, problem), 28U);
  EXPECT_TRUE(splice(state, problem, proposal(0, cheap)));
  EXPECT_EQ(cost_ahead(state, problem), 4U);
  EXPECT_FALSE(splice(state, problem, proposal(0, dear))) << "dearer";
  EXPECT_FALSE(splice(state, problem, proposal(0, {{1, 1}, {2, 1}, {3, 1}, {4, 1}}))) << "from elsewhere";
  EXPECT_FALSE(splice(state, problem, proposal(0, {{0, 1}, {1, 1}}))) << "no catch";
  pass_second(state, problem);
  EXPECT_FALSE(splice(state, problem, proposal(0, dear))) << "passed by";
  EXPECT_EQ(cost_ahead(state, problem), 3U);
}

TEST(PursuitState, AFutureSpliceKeepsTheWayUntilThere) {
  const auto problem = drawn_pursuit({"99999", "11111"}, {0, 0}, standing({4, 1}, 12));
  PursuitState state = begin_pursuit({{0, 0}});
  state.ahead = {{1, 0}, {2, 1}, {3, 1}, {4, 1}};
  EXPECT_EQ(robot_at(state, 0, 1), (Cell{1, 0}));
  EXPECT_EQ(robot_at(state, 0, 9), (Cell{4, 1}));
  EXPECT_EQ(question(state, problem, 0, 1).start_s, 1);
  EXPECT_TRUE(splice(state, problem, proposal(1, {{1, 0}, {2, 0}, {3, 0}, {4, 1}})));
  EXPECT_EQ(state.ahead, (std::vector<Cell>{{1, 0}, {2, 0}, {3, 0}, {4, 1}}));
}

TEST(PursuitState, OneRobotIsOnDutyAndPays) {
  const auto problem = drawn_pursuit({"5111115"}, {0, 0}, standing({4, 0}, 12));
  PursuitState state = begin_pursuit({{0, 0}, {6, 0}});
  PursuitProposal far = proposal(0, {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}});
  PursuitProposal near = proposal(0, {{6, 0}, {5, 0}, {4, 0}});
  near.robot = 1;
  splice(state, problem, far);
  splice(state, problem, near);
  pass_second(state, problem);
  EXPECT_EQ(state.duty, 1U);
  EXPECT_EQ(state.handovers, 0);
  EXPECT_EQ(state.robots, (std::vector<Cell>{{0, 0}, {5, 0}}));
  pass_second(state, problem);
  EXPECT_TRUE(state.caught);
  EXPECT_EQ(state.cost, 6U);
}

}  // namespace
}  // namespace outrider
