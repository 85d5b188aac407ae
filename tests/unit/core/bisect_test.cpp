#include "outrider/core/bisect.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace outrider {
namespace {

TEST(Bisect, FindsWhereAConditionCeasesToHold) {
  const auto below_root = [](double x) { return x * x <= 2.0; };
  const double found = last_while(1.0, 3.0, 40, below_root);
  EXPECT_TRUE(below_root(found));
  EXPECT_LE(found, std::sqrt(2.0));
  EXPECT_GE(found, std::sqrt(2.0) - std::ldexp(2.0, -40));
}

TEST(Bisect, GivesTheEndWhereTheConditionHoldsThere) {
  EXPECT_EQ(largest_up_to(0.7, 12, [](double) { return true; }), 0.7);
  EXPECT_NEAR(largest_up_to(1.0, 12, [](double x) { return x <= 0.3; }), 0.3, std::ldexp(1.0, -12));
}

}  // namespace
}  // namespace outrider
