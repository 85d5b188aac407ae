#include "outrider/jobs/pursue/mission.hpp"

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

TEST(PursuitMission, CallsCostWholeSeconds) {
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

TEST(PursuitMission, ALateAnswerChargesTheCellInWhichTheRobotWaited) {
  const auto problem = drawn_pursuit({"7123"}, {0, 0}, standing({3, 0}, 10));
  PursuitMission mission = begin_pursuit({{0, 0}});
  // The call takes 3.5 s: two seconds of waiting pass, then the answer, made to begin there, is taken up.
  EXPECT_TRUE(step(mission, problem, problem, {proposal(2, {{0, 0}, {1, 0}, {2, 0}, {3, 0}})}, 3.5));
  EXPECT_EQ(mission.time_s, 3);
  EXPECT_EQ(mission.cost, 21U);
  EXPECT_EQ(mission.robots[0], (Cell{1, 0}));
  pass_second(mission, problem);
  pass_second(mission, problem);
  EXPECT_TRUE(mission.caught);
  EXPECT_EQ(mission.time_s, 5);
  EXPECT_EQ(mission.cost, 21U + 1U + 2U);
  EXPECT_EQ(mission.moves, 3);
  pass_second(mission, problem);
  EXPECT_EQ(mission.time_s, 5);
}

TEST(PursuitMission, SecondZeroDoesNotCountAndTheLastOneDoes) {
  const auto together = drawn_pursuit({"11"}, {0, 0}, {{0, 0}});
  PursuitMission mission = begin_pursuit({{0, 0}});
  EXPECT_FALSE(mission.caught);
  EXPECT_TRUE(is_over(mission, together));
  const auto last = drawn_pursuit({"11"}, {0, 0}, {{0, 0}, {1, 0}});
  mission = begin_pursuit({{0, 0}});
  step(mission, last, last, {proposal(0, {{0, 0}, {1, 0}})}, 1.9);
  EXPECT_TRUE(mission.caught);
  EXPECT_EQ(mission.time_s, 1);
}

TEST(PursuitMission, TheRobotGoesOnWhileThePlannerThinks) {
  const auto problem = drawn_pursuit({"11111111"}, {0, 0}, standing({5, 0}, 20));
  PursuitMission mission = begin_pursuit({{0, 0}});
  mission.ahead = {{1, 0}, {2, 0}, {3, 0}, {4, 0}, {5, 0}};
  step(mission, problem, problem, {}, 4.2);
  EXPECT_EQ(mission.robots[0], (Cell{4, 0}));
  EXPECT_EQ(mission.moves, 4);
}

TEST(PursuitMission, OnlyWhatIsCheaperAndOnTheWayIsTakenUp) {
  // Over the lower row the way is dearer.
  const auto problem = drawn_pursuit({"11111", "99999"}, {0, 1}, standing({4, 1}, 12));
  PursuitMission mission = begin_pursuit({{0, 1}});
  const std::vector<Cell> dear = {{0, 1}, {1, 0}, {2, 0}, {3, 0}, {4, 1}};
  const std::vector<Cell> cheap = {{0, 1}, {1, 1}, {2, 1}, {3, 1}, {4, 1}};
  EXPECT_TRUE(splice(mission, problem, proposal(0, dear)));
  EXPECT_EQ(cost_ahead(mission, problem), 28U);
  EXPECT_TRUE(splice(mission, problem, proposal(0, cheap)));
  EXPECT_EQ(cost_ahead(mission, problem), 4U);
  EXPECT_FALSE(splice(mission, problem, proposal(0, dear))) << "dearer";
  EXPECT_FALSE(splice(mission, problem, proposal(0, {{1, 1}, {2, 1}, {3, 1}, {4, 1}}))) << "from elsewhere";
  EXPECT_FALSE(splice(mission, problem, proposal(0, {{0, 1}, {1, 1}}))) << "no catch";
  pass_second(mission, problem);
  EXPECT_FALSE(splice(mission, problem, proposal(0, dear))) << "passed by";
  EXPECT_EQ(cost_ahead(mission, problem), 3U);
}

TEST(PursuitMission, AFutureSpliceKeepsTheWayUntilThere) {
  const auto problem = drawn_pursuit({"99999", "11111"}, {0, 0}, standing({4, 1}, 12));
  PursuitMission mission = begin_pursuit({{0, 0}});
  mission.ahead = {{1, 0}, {2, 1}, {3, 1}, {4, 1}};
  EXPECT_EQ(robot_at(mission, 0, 1), (Cell{1, 0}));
  EXPECT_EQ(robot_at(mission, 0, 9), (Cell{4, 1}));
  EXPECT_EQ(question(mission, problem, 0, 1).start_s, 1);
  EXPECT_TRUE(splice(mission, problem, proposal(1, {{1, 0}, {2, 0}, {3, 0}, {4, 1}})));
  EXPECT_EQ(mission.ahead, (std::vector<Cell>{{1, 0}, {2, 0}, {3, 0}, {4, 1}}));
}

TEST(PursuitMission, OneRobotIsOnDutyAndPays) {
  const auto problem = drawn_pursuit({"5111115"}, {0, 0}, standing({4, 0}, 12));
  PursuitMission mission = begin_pursuit({{0, 0}, {6, 0}});
  PursuitProposal far = proposal(0, {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {4, 0}});
  PursuitProposal near = proposal(0, {{6, 0}, {5, 0}, {4, 0}});
  near.robot = 1;
  step(mission, problem, problem, {far, near}, 0.0);
  EXPECT_EQ(mission.duty, 1U);
  EXPECT_EQ(mission.handovers, 0);
  EXPECT_EQ(mission.robots, (std::vector<Cell>{{0, 0}, {5, 0}}));
  pass_second(mission, problem);
  EXPECT_TRUE(mission.caught);
  EXPECT_EQ(mission.cost, 6U);
}

}  // namespace
}  // namespace outrider
