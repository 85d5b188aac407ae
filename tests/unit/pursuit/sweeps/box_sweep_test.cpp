#include "sweeps/box_sweep.hpp"

#include <gtest/gtest.h>

#include "outrider/pursuit/anytime.hpp"
#include "outrider/pursuit/check.hpp"
#include "support/pursuit_oracle.hpp"
#include "support/random_cases.hpp"
#include "support/smooth_pursuit.hpp"

namespace outrider {
namespace {

void run_in_slices(BoxSweep& sweep, std::uint64_t slice) {
  Budget budget;
  budget.expansions = slice;
  for (bool done = false; !done;) {
    BudgetMeter meter(budget);
    done = sweep.run(meter);
  }
}

TEST(BoxSweep, FindsTheCheapestCatchAndTheEarliestSecond) {
  Rng rng(91);
  int catches = 0, none = 0, dear = 0;
  for (int k = 0; k < testing::cases(4000) && !::testing::Test::HasFailure(); ++k) {
    SCOPED_TRACE("case " + std::to_string(k));
    const PursuitProblem problem = testing::random_pursuit(rng, 40, 30);
    BoxSweep sweep(problem);
    if (!sweep.prepare()) {
      ++dear;
      continue;
    }
    run_in_slices(sweep, 1 + rng.below(50));
    const auto truth = testing::slow_catch(problem);
    const auto plan = sweep.plan();
    ASSERT_EQ(plan.has_value(), truth.has_value());
    if (!truth) {
      ++none;
      continue;
    }
    ++catches;
    EXPECT_EQ(plan->cost, truth->cost);
    EXPECT_EQ(plan->earliest_catch_s, truth->earliest_s);
    const Status good = check(*plan, problem);
    EXPECT_TRUE(good) << to_string(good.error());
  }
  EXPECT_GT(catches, 300);
  EXPECT_GT(none, 300);
  EXPECT_GT(dear, 100);
}

TEST(BoxSweep, CellsOutsideOfTheBoxesAreNotRead) {
  CostGrid costs(GridFrame{{0, 0}, 1.0, 300, 300});
  std::ranges::fill(costs.cells, 4'000'000'000U);  // too dear for the sweep
  for (int x = 100; x <= 140; ++x) costs[{x, 100}] = 1;
  PursuitProblem problem;
  problem.threshold = 4'000'000'001U;
  problem.start = {100, 100};
  for (int x = 140; x >= 100; --x) problem.target.push_back({x, 100});
  problem.costs = std::make_shared<const CostGrid>(costs);
  EXPECT_FALSE(BoxSweep(problem).prepare()) << "the premise: rows beside the corridor are in the boxes";
  for (int y = 60; y <= 140; ++y) {
    for (int x = 60; x <= 140; ++x) costs[{x, y}] = 1;
  }
  problem.costs = std::make_shared<const CostGrid>(costs);
  BoxSweep sweep(problem);
  ASSERT_TRUE(sweep.prepare());
  run_in_slices(sweep, 1'000'000);
  EXPECT_EQ(sweep.plan()->cost, 20U);
}

TEST(BoxSweep, IsTakenWhereTheBoxesHoldFewCells) {
  PursuitProblem problem = testing::smooth_pursuit({100, 90, 1, 100, testing::Walk::wander, 5});
  AnytimePursuit search(problem);
  ASSERT_TRUE(search.improve(Budget{}));
  EXPECT_TRUE(search.proven()) << "the first catch is the cheapest one";
  const auto truth = testing::slow_catch(problem);
  EXPECT_EQ(search.best()->cost, truth->cost);
  EXPECT_EQ(search.earliest_catch_s(), truth->earliest_s);
  EXPECT_TRUE(search.keep_to(problem.start_s + 1));
}

}  // namespace
}  // namespace outrider
