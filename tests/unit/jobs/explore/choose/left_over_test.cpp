#include "outrider/jobs/explore/choose/left_over.hpp"

#include <gtest/gtest.h>

namespace outrider {
namespace {

LeftOver narrow_at(Vec2 gap, double area_m2) {
  return {1, gap + Vec2{1.0, 0.0}, LeftReason::narrow, 0.2, gap, area_m2, "too narrow"};
}

TEST(LeftOver, WhatLiesBehindGapsIsTakenOutAndNamed) {
  LeftOvers left;
  left.places = {narrow_at({0.0, 0.0}, 2.0), narrow_at({0.1, 0.0}, 1.0), narrow_at({5.0, 0.0}, 0.5)};
  left.places.push_back({2, {9.0, 0.0}, LeftReason::touched, 0.0, {9.0, 0.0}, 4.0, "touched"});
  const LeftOvers behind = take_behind_gaps(left, {});
  EXPECT_EQ(
      behind.behind_gaps(0.24),
      "up to 3.5 m2 lie behind 2 gaps too narrow for the robot, at most 0.200 m wide where it wants 0.240 m");
  ASSERT_EQ(left.places.size(), 1U);
  EXPECT_EQ(left.places[0].reason, LeftReason::touched);
}

TEST(LeftOver, AGapThatMayBeWideEnoughIsLeftOverUntilItWasMeasured) {
  const NarrowPlace tried{{0.0, 0.0}, 0.0, false, 1}, measured{{0.2, 0.0}, 0.22, true, 0};
  LeftOvers left;
  left.places = {narrow_at({0.0, 0.0}, 2.0)};
  EXPECT_TRUE(take_behind_gaps(left, {tried}).places.empty());
  EXPECT_EQ(left.places.size(), 1U);
  EXPECT_EQ(take_behind_gaps(left, {tried, measured}).places.size(), 1U);
  EXPECT_TRUE(left.places.empty());
}

}  // namespace
}  // namespace outrider
