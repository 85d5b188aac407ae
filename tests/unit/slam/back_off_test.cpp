#include "back_off.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace outrider {
namespace {

int searches(BackOff& back_off, int occasions, bool found) {
  int count = 0;
  for (int i = 0; i < occasions; ++i) {
    if (!back_off.take_occasion()) continue;
    back_off.note(found);
    ++count;
  }
  return count;
}

TEST(BackOff, OfManyOccasionsAboutTheRootIsSearched) {
  for (const int occasions : {100, 1000, 100000}) {
    BackOff back_off;
    EXPECT_NEAR(searches(back_off, occasions, false), std::sqrt(8.0 * occasions), 4.0) << occasions;
  }
}

TEST(BackOff, TheFirstAreSearchedAndSoAreThoseThatFind) {
  BackOff back_off;
  EXPECT_EQ(searches(back_off, 4, false), 4);
  BackOff lucky;
  EXPECT_EQ(searches(lucky, 1000, true), 1000);
}

TEST(BackOff, WhatIsFoundMakesSearchesFrequentAgain) {
  BackOff back_off;
  searches(back_off, 5000, false);
  const int before = searches(back_off, 200, false);
  searches(back_off, 200, true);
  EXPECT_GE(searches(back_off, 200, false), 5 * before);
}

}  // namespace
}  // namespace outrider
