#include "outrider/pursuit/catalog.hpp"

#include <gtest/gtest.h>

#include "outrider/pursuit/check.hpp"
#include "support/pursuit_oracle.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

TEST(PursuitCatalog, EveryPlannerKeepsItsPromise) {
  Rng rng(71);
  Workspace workspace;
  for (int k = 0; k < testing::cases(500); ++k) {
    const PursuitProblem problem = testing::random_pursuit(rng, 7, 16);
    const auto truth = testing::slow_catch(problem);
    for (const PursuitPlanner& planner : pursuit_planners()) {
      const auto what = std::string(planner.name) + ", case " + std::to_string(k);
      const Outcome<PursuitPlan> plan = planner.configure().plan(problem, {}, workspace);
      const Outcome<PursuitPlan> again = planner.configure().plan(problem, {}, workspace);
      ASSERT_EQ(plan.has_value(), again.has_value()) << what;
      if (planner.guarantee.complete) {
        EXPECT_EQ(plan.has_value(), truth.has_value()) << what;
      }
      if (!plan) continue;
      EXPECT_EQ(*plan, *again) << what;
      const Status good = certify(*plan, problem, {});
      EXPECT_TRUE(good) << what << ": " << to_string(good.error());
      if (planner.guarantee.optimal) {
        EXPECT_EQ(plan->cost, truth->cost) << what;
      }
    }
  }
}

TEST(PursuitCatalog, AnUnknownNameIsToldTheNearest) {
  EXPECT_TRUE(find_pursuit_planner("optimal"));
  const auto unknown = find_pursuit_planner("optimall");
  ASSERT_FALSE(unknown);
  EXPECT_NE(unknown.error().sentence.find("did you mean 'optimal'"), std::string::npos);
}

}  // namespace
}  // namespace outrider
