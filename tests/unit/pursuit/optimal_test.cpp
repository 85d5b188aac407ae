#include "outrider/pursuit/optimal.hpp"

#include <gtest/gtest.h>

#include "outrider/pursuit/check.hpp"
#include "outrider/pursuit/miss.hpp"
#include "outrider/pursuit/sweep.hpp"
#include "support/pursuit_oracle.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

using testing::drawn_pursuit;
using testing::random_pursuit;
using testing::slow_catch;
using testing::SlowCatch;

Outcome<PursuitPlan> solve(const PursuitProblem& problem) {
  Workspace workspace;
  return optimal_pursuit(problem, {}, {}, workspace);
}

void expect_optimal(const PursuitProblem& problem, const std::string& what) {
  const std::optional<SlowCatch> truth = slow_catch(problem);
  const Outcome<PursuitPlan> plan = solve(problem);
  ASSERT_EQ(plan.has_value(), truth.has_value()) << what;
  EXPECT_EQ(why_no_catch(problem).has_value(), !truth.has_value()) << what;
  const Outcome<LeastCatch> swept = sweep(problem, {});
  ASSERT_EQ(swept.has_value(), truth.has_value()) << what;
  if (!truth) {
    EXPECT_EQ(plan.error().code, FaultCode::no_path) << what;
    return;
  }
  const Status good = certify(*plan, problem, {});
  EXPECT_TRUE(good) << what << ": " << to_string(good.error());
  EXPECT_EQ(plan->cost, truth->cost) << what;
  EXPECT_EQ(plan->lower_bound, truth->cost) << what;
  EXPECT_EQ(plan->earliest_catch_s, truth->earliest_s) << what;
  EXPECT_EQ(swept->cost, truth->cost) << what;
  EXPECT_EQ(swept->earliest_catch_s, truth->earliest_s) << what;
}

TEST(OptimalPursuit, EqualsTheSweepOfEveryCellInEverySecond) {
  Rng rng(41);
  for (int k = 0; k < testing::cases(20000) && !::testing::Test::HasFailure(); ++k) {
    expect_optimal(random_pursuit(rng, 7, 20), "case " + std::to_string(k));
  }
}

TEST(OptimalPursuit, EqualsTheSweepOnLongerPursuits) {
  Rng rng(42);
  for (int k = 0; k < testing::cases(300) && !::testing::Test::HasFailure(); ++k) {
    expect_optimal(random_pursuit(rng, 24, 90), "case " + std::to_string(k));
  }
}

}  // namespace
}  // namespace outrider
