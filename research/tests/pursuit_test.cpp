// Tests where the reference methods work, and where and why they fail.
#include <gtest/gtest.h>

#include "outrider/pursuit/catalog.hpp"
#include "outrider/pursuit/check.hpp"
#include "outrider/pursuit/optimal.hpp"
#include "research/pursuit/iterative_a_star.hpp"
#include "research/pursuit/multi_goal_a_star.hpp"
#include "research/pursuit/real_time.hpp"
#include "research/research.hpp"
#include "support/pursuit_oracle.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

using testing::drawn_pursuit;

/// A target that goes to and fro between x = low and high in the lowest row.
std::vector<Cell> to_and_fro(int low, int high, int seconds) {
  std::vector<Cell> cells;
  for (int s = 0, x = low, step = 1; s < seconds; ++s) {
    cells.push_back({x, 0});
    if (x + step < low || x + step > high) step = -step;
    x += step;
  }
  return cells;
}

TEST(ResearchRealTimeSearch, NeverCatchesATargetThatKeepsGoingAway) {
  Workspace workspace;
  std::vector<Cell> target;
  for (int x = 2; x < 20; ++x) target.push_back({x, 0});
  const auto problem = drawn_pursuit({"11111111111111111111"}, {0, 0}, target);
  for (const auto& answer : {lrta_star(problem, {}, {}, workspace), rtaa_star(problem, {}, {}, workspace)}) {
    ASSERT_FALSE(answer);
    EXPECT_EQ(answer.error().code, FaultCode::budget_exhausted);
    EXPECT_NE(answer.error().sentence.find("2 cells behind"), std::string::npos) << answer.error().sentence;
  }
}

TEST(ResearchRealTimeSearch, CatchesATargetThatStops) {
  Workspace workspace;
  std::vector<Cell> target = to_and_fro(3, 7, 20);
  target.resize(30, target.back());
  const auto problem = drawn_pursuit({"11111111"}, {0, 0}, target);
  for (const auto& plan : {lrta_star(problem, {}, {}, workspace), rtaa_star(problem, {}, {}, workspace)}) {
    ASSERT_TRUE(plan) << plan.error().sentence;
    EXPECT_TRUE(check(*plan, problem));
  }
}

TEST(ResearchRealTimeSearch, RtaaStarLooksOutOfAPocketInWhichLrtaStarLearnsForLong) {
  Workspace workspace;
  const auto problem = drawn_pursuit({"11111111", "1111###1", "111111#1", "111111#1", "1111###1", "11111111"},
                                     {5, 3}, std::vector<Cell>(200, Cell{7, 3}));
  const auto lrta = lrta_star(problem, {}, {}, workspace);
  const auto rtaa = rtaa_star(problem, {}, {}, workspace);
  ASSERT_TRUE(lrta && rtaa);
  EXPECT_LT(rtaa->catch_time_s, lrta->catch_time_s);
}

TEST(ResearchIterativeAStar, PaysForWaitingAtTheGoalWhereTheOptimumWaitsElsewhere) {
  // The target is above a wall until its last second; waiting is free where the robot starts, dear there.
  std::vector<Cell> target(9, Cell{0, 1});
  target.push_back({3, 0});
  const auto problem = drawn_pursuit({"####", "0119"}, {0, 0}, target);
  Workspace workspace;
  const auto reference = iterative_a_star(problem, {1}, {}, workspace);
  const auto optimum = optimal_pursuit(problem, {}, {}, workspace);
  ASSERT_TRUE(reference && optimum);
  EXPECT_GT(reference->cost, optimum->cost);
  EXPECT_EQ(optimum->cost, testing::slow_catch(problem)->cost);
}

TEST(ResearchIterativeAStar, PenaltiesMakeALateWayFit) {
  // The cheap way round is one of five steps, but the target is gone after second 3.
  const auto problem = drawn_pursuit({"1991", "1##1", "1111"}, {0, 2}, std::vector<Cell>(4, Cell{3, 2}));
  Workspace workspace;
  const auto plan = iterative_a_star(problem, {}, {}, workspace);
  ASSERT_TRUE(plan) << plan.error().sentence;
  EXPECT_EQ(plan->cost, 19U);
  EXPECT_TRUE(check(*plan, problem));
}

TEST(ResearchMultiGoalAStar, GivesUpWhereItsStatesDoNotFit) {
  const auto problem =
      drawn_pursuit({"0000000000", "0000000000", "0000000000"}, {0, 0}, to_and_fro(5, 9, 60));
  Workspace workspace;
  EXPECT_TRUE(multi_goal_a_star(problem, {}, {}, workspace));
  const auto small = multi_goal_a_star(problem, {20}, {}, workspace);
  ASSERT_FALSE(small);
  EXPECT_EQ(small.error().code, FaultCode::budget_exhausted);
}

/// The laws of tests/unit/pursuit/catalog_test.cpp.
TEST(ResearchCatalog, EveryPursuitPlannerKeepsItsPromise) {
  const std::size_t own = pursuit_planners().size();
  add_research();
  ASSERT_EQ(pursuit_planners().size(), own + 4);
  Rng rng(71);
  Workspace workspace;
  for (int k = 0; k < testing::cases(500); ++k) {
    const PursuitProblem problem = testing::random_pursuit(rng, 7, 16);
    const auto truth = testing::slow_catch(problem);
    for (std::size_t row = own; row < own + 4; ++row) {
      const PursuitPlanner& planner = pursuit_planners()[row];
      const auto plan = planner.configure().plan(problem, {}, workspace);
      const auto again = planner.configure().plan(problem, {}, workspace);
      ASSERT_EQ(plan.has_value(), again.has_value()) << planner.name << ", case " << k;
      if (!plan) continue;
      EXPECT_EQ(*plan, *again) << planner.name << ", case " << k;
      EXPECT_TRUE(certify(*plan, problem, {})) << planner.name << ", case " << k;
      EXPECT_GE(plan->cost, truth->cost) << planner.name << ", case " << k;
      if (planner.guarantee.optimal) {
        EXPECT_EQ(plan->cost, truth->cost) << planner.name << ", case " << k;
      }
    }
  }
}

}  // namespace
}  // namespace outrider
