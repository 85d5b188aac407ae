#include "outrider/core/outcome.hpp"

#include <gtest/gtest.h>

#include <set>

namespace outrider {
namespace {

Outcome<int> half(int x) {
  if (x % 2 != 0) return bad_input("3 is odd; give an even number", "--x");
  return x / 2;
}

Outcome<double> quarter(int x) {
  auto outcome = half(x);
  if (!outcome) return pass_on(outcome);
  return *outcome / 2.0;
}

TEST(Outcome, HoldsAValueOrAFault) {
  EXPECT_EQ(half(4).value(), 2);
  ASSERT_FALSE(half(3));
  EXPECT_EQ(half(3).error().code, FaultCode::bad_input);
}

TEST(Outcome, AFaultIsPassedOnWhole) {
  EXPECT_EQ(quarter(4).value(), 1.0);
  ASSERT_FALSE(quarter(3));
  EXPECT_EQ(to_string(quarter(3).error()), "--x: 3 is odd; give an even number");
}

TEST(Outcome, WithoutAPlaceTheSentenceStandsAlone) {
  EXPECT_EQ(to_string(Fault{FaultCode::no_path, "nothing joins them", ""}), "nothing joins them");
}

TEST(Outcome, EveryCodeHasItsOwnName) {
  std::set<std::string_view> names;
  for (const FaultCode code :
       {FaultCode::start_blocked, FaultCode::goal_blocked, FaultCode::outside_map, FaultCode::no_path,
        FaultCode::no_shot, FaultCode::budget_exhausted, FaultCode::cancelled, FaultCode::bad_input}) {
    names.insert(to_string(code));
  }
  EXPECT_EQ(names.size(), 8U);
  EXPECT_FALSE(names.contains("unknown"));
}

}  // namespace
}  // namespace outrider
