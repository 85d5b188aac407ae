#include "outrider/pursuit/anytime.hpp"

#include <gtest/gtest.h>

#include "outrider/pursuit/check.hpp"
#include "support/pursuit_oracle.hpp"
#include "support/random_cases.hpp"
#include "support/smooth_pursuit.hpp"

namespace outrider {
namespace {

using testing::random_pursuit;
using testing::slow_catch;
using testing::SlowCatch;

Budget expansions(std::uint64_t count) {
  Budget budget;
  budget.expansions = count;
  return budget;
}

/// Works in slices, judging best() and lower_bound() after each. Nothing when there is no catch.
std::optional<PursuitPlan> judged(const PursuitProblem& problem, std::uint64_t slice,
                                  const std::optional<SlowCatch>& truth) {
  AnytimePursuit search(problem);
  std::uint64_t cost = ~std::uint64_t{0}, bound = 0;
  while (!search.proven()) {
    if (const Status worked = search.improve(expansions(slice)); !worked) {
      EXPECT_EQ(worked.error().code, FaultCode::no_path);
      EXPECT_FALSE(truth);
      return {};
    }
    if (!search.best() || ::testing::Test::HasFailure()) continue;
    const Status good = check(*search.best(), problem);
    EXPECT_TRUE(good) << to_string(good.error());
    EXPECT_LE(search.best()->cost, cost);
    EXPECT_GE(search.lower_bound(), bound);
    EXPECT_LE(search.lower_bound(), truth->cost);
    EXPECT_EQ(search.best()->lower_bound, search.lower_bound());
    EXPECT_EQ(search.earliest_catch_s(), truth->earliest_s);
    cost = search.best()->cost;
    bound = search.lower_bound();
  }
  return search.best();
}

TEST(AnytimePursuit, EveryAnswerOnTheWayIsTrue) {
  Rng rng(51);
  for (int k = 0; k < testing::cases(2000) && !::testing::Test::HasFailure(); ++k) {
    SCOPED_TRACE("case " + std::to_string(k));
    const PursuitProblem problem = random_pursuit(rng, 9, 30);
    const std::optional<SlowCatch> truth = slow_catch(problem);
    const std::uint64_t slice = 1 + rng.below(40);
    const std::optional<PursuitPlan> slow = judged(problem, slice, truth);
    const std::optional<PursuitPlan> fast = judged(problem, 1'000'000, truth);
    ASSERT_EQ(slow.has_value(), truth.has_value());
    ASSERT_EQ(fast.has_value(), truth.has_value());
    EXPECT_EQ(slow, judged(problem, slice, truth));
    if (!truth) continue;
    EXPECT_EQ(slow->cost, truth->cost);
    EXPECT_EQ(slow->path, fast->path) << "the slices of the budget show in the answer";
  }
}

TEST(AnytimePursuit, PlanningOnFromAnOptimalPathKeepsItsCost) {
  Rng rng(52);
  Workspace workspace;
  for (int k = 0; k < testing::cases(1000); ++k) {
    PursuitProblem problem = random_pursuit(rng, 8, 25);
    const auto plan = anytime_pursuit(problem, {}, {}, workspace);
    if (!plan || plan->path.size() < 3) continue;
    const std::size_t passed = 1 + rng.below(plan->path.size() - 2);
    std::uint64_t paid = 0;
    for (std::size_t i = 0; i < passed; ++i) paid += (*problem.costs)[plan->path[i]];
    problem.start = plan->path[passed];
    problem.start_s += static_cast<int>(passed);
    const auto rest = anytime_pursuit(problem, {}, {}, workspace);
    ASSERT_TRUE(rest);
    EXPECT_EQ(paid + rest->cost, plan->cost) << "case " << k;
  }
}

TEST(AnytimePursuit, ARobotThatGoesOnMeanwhileStillGetsTheCheapestRest) {
  Rng rng(53);
  int moved = 0;
  for (int k = 0; k < testing::cases(1500) && !::testing::Test::HasFailure(); ++k) {
    SCOPED_TRACE("case " + std::to_string(k));
    PursuitProblem problem = random_pursuit(rng, 8, 30);
    if (k % 3 == 0) {  // so long that not all is swept at once
      const std::vector<Cell> few = problem.target;
      while (problem.target.size() < 1500) problem.target.push_back(few[problem.target.size() % few.size()]);
    }
    AnytimePursuit search(problem);
    int robot_s = problem.start_s;
    std::vector<Cell> gone;
    while (!search.proven()) {
      if (!search.improve(expansions(1 + rng.below(200)))) break;
      if (!search.best()) continue;
      const std::vector<Cell>& path = search.best()->path;
      ASSERT_TRUE(std::equal(gone.begin(), gone.end(), path.begin())) << "it left the path that it was on";
      if (!search.keep_to(robot_s + 1)) continue;
      ++robot_s;
      gone.assign(path.begin(), path.begin() + robot_s - problem.start_s + 1);
    }
    if (!search.best()) continue;
    const Status good = check(*search.best(), problem);
    ASSERT_TRUE(good) << to_string(good.error());
    if (gone.empty()) continue;
    ++moved;
    std::uint64_t paid = 0;
    for (std::size_t i = 0; i + 1 < gone.size(); ++i) paid += (*problem.costs)[gone[i]];
    problem.start = gone.back();
    problem.start_s = robot_s;
    EXPECT_EQ(search.best()->cost, paid + slow_catch(problem)->cost);
  }
  EXPECT_GT(moved, testing::cases(1500) / 10);
}

TEST(AnytimePursuit, OnASmoothMapTheCatchGetsCheaperStepByStep) {
  testing::SmoothPursuit of;
  of.side = 500;
  of.seconds = 1500;
  of.seed = 2;
  AnytimePursuit search(testing::smooth_pursuit(of));
  std::vector<std::uint64_t> costs;
  while (!search.proven()) {
    ASSERT_TRUE(search.improve(expansions(20'000)));
    if (search.best()) costs.push_back(search.best()->cost);
  }
  ASSERT_TRUE(std::is_sorted(costs.rbegin(), costs.rend()));
  costs.erase(std::unique(costs.begin(), costs.end()), costs.end());
  EXPECT_GE(costs.size(), 5U);
}

PursuitProblem open_field(int side) {
  GridFrame frame;
  frame.width = frame.height = side;
  CostGrid costs(frame, 3);
  PursuitProblem problem;
  problem.costs = std::make_shared<const CostGrid>(std::move(costs));
  problem.threshold = 4;
  problem.target.assign(static_cast<std::size_t>(2 * side), Cell{side - 1, side - 1});
  return problem;
}

TEST(AnytimePursuit, AnEmptyBudgetIsNoFaultAndCostsNothing) {
  AnytimePursuit search(open_field(20));
  ASSERT_TRUE(search.improve(expansions(0)));
  EXPECT_FALSE(search.best());
  EXPECT_FALSE(search.proven());
  ASSERT_TRUE(search.improve(expansions(100'000)));
  EXPECT_TRUE(search.proven());
  EXPECT_EQ(search.best()->cost, 57U);
}

TEST(AnytimePursuit, CancellingEndsIt) {
  std::stop_source source;
  source.request_stop();
  Budget budget;
  budget.stop = source.get_token();
  AnytimePursuit search(open_field(20));
  const Status worked = search.improve(budget);
  ASSERT_FALSE(worked);
  EXPECT_EQ(worked.error().code, FaultCode::cancelled);
}

TEST(AnytimePursuit, WithoutBudgetForAnyCatchItSaysSo) {
  Workspace workspace;
  const auto plan = anytime_pursuit(open_field(20), {}, expansions(10), workspace);
  ASSERT_FALSE(plan);
  EXPECT_EQ(plan.error().code, FaultCode::budget_exhausted);
}

}  // namespace
}  // namespace outrider
