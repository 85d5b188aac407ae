#include "outrider/pursuit/optimal.hpp"

#include <gtest/gtest.h>

#include "outrider/pursuit/check.hpp"
#include "outrider/pursuit/miss.hpp"
#include "outrider/pursuit/sweep.hpp"
#include "support/layer_programme.hpp"
#include "support/pursuit_oracle.hpp"
#include "support/random_cases.hpp"
#include "support/smooth_pursuit.hpp"

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
  EXPECT_EQ(testing::LayerProgramme(problem).least_cost().value_or(truth->cost), truth->cost) << what;
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

/// On few cells with many seconds the relaxations come first; elsewhere the sweep is taken at once.
TEST(OptimalPursuit, EqualsTheSweepOnFewCellsAndManySeconds) {
  Rng rng(43);
  for (int k = 0; k < testing::cases(150) && !::testing::Test::HasFailure(); ++k) {
    PursuitProblem problem = random_pursuit(rng, 5, 20);
    const std::vector<Cell> few = problem.target;
    while (problem.target.size() < 2500)
      problem.target.push_back(few[problem.target.size() / 7 % few.size()]);
    expect_optimal(problem, "case " + std::to_string(k));
  }
}

TEST(OptimalPursuit, EqualsTheProgrammeOverLayersOnSmoothMaps) {
  Rng rng(44);
  for (int k = 0; k < testing::cases(60) && !::testing::Test::HasFailure(); ++k) {
    testing::SmoothPursuit of;
    of.side = 20 + static_cast<int>(rng.below(100));
    of.seconds = 50 + static_cast<int>(rng.below(2500));
    of.least = 1 + static_cast<std::uint32_t>(rng.below(60));
    of.walk = static_cast<testing::Walk>(rng.below(3));
    of.seed = rng.below(1000);
    const PursuitProblem problem = testing::smooth_pursuit(of);
    const auto least = testing::LayerProgramme(problem).least_cost();
    const auto plan = solve(problem);
    ASSERT_EQ(plan.has_value(), least.has_value()) << "case " << k;
    if (!least) continue;
    EXPECT_TRUE(check(*plan, problem)) << "case " << k;
    EXPECT_EQ(plan->cost, *least) << "case " << k;
  }
}

}  // namespace
}  // namespace outrider
