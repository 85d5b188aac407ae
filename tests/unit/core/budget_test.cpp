#include "outrider/core/budget.hpp"

#include <gtest/gtest.h>

namespace outrider {
namespace {

using std::chrono::hours;
using std::chrono::nanoseconds;

TEST(Budget, CountsExpansionsExactly) {
  for (const std::uint64_t limit : {0U, 1U, 1023U, 1024U, 1025U, 5000U}) {
    Budget budget;
    budget.expansions = limit;
    BudgetMeter meter(budget);
    std::uint64_t spent = 0;
    while (meter.spend()) ++spent;
    EXPECT_EQ(spent, limit);
    EXPECT_EQ(meter.spent(), limit);
    EXPECT_FALSE(meter.spend());
    EXPECT_EQ(meter.refusal().value().code, FaultCode::budget_exhausted);
    EXPECT_NE(meter.refusal().value().sentence.find(std::to_string(limit)), std::string::npos);
  }
}

TEST(Budget, HasNoLimitUnlessGivenOne) {
  BudgetMeter meter{Budget{}};
  for (int i = 0; i < 100000; ++i) ASSERT_TRUE(meter.spend());
}

TEST(Budget, AStopIsSeenAtTheNextExpansion) {
  std::stop_source source;
  Budget budget;
  budget.stop = source.get_token();
  BudgetMeter meter(budget);
  for (int i = 0; i < 5000; ++i) ASSERT_TRUE(meter.spend());
  source.request_stop();
  EXPECT_FALSE(meter.spend());
  EXPECT_EQ(meter.refusal().value().code, FaultCode::cancelled);
}

TEST(Budget, AStopBeforeTheStartAllowsNothing) {
  std::stop_source source;
  source.request_stop();
  Budget budget;
  budget.stop = source.get_token();
  BudgetMeter meter(budget);
  EXPECT_FALSE(meter.spend());
  EXPECT_EQ(meter.spent(), 0U);
}

TEST(Budget, WallTimeEndsTheSearch) {
  Budget none;
  none.wall_time = nanoseconds(0);
  BudgetMeter ended(none);
  EXPECT_FALSE(ended.spend());
  EXPECT_EQ(ended.refusal().value().code, FaultCode::budget_exhausted);

  Budget ample;
  ample.wall_time = hours(1);
  BudgetMeter running(ample);
  for (int i = 0; i < 5000; ++i) ASSERT_TRUE(running.spend());
}

}  // namespace
}  // namespace outrider
