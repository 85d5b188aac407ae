#include "outrider/jobs/slam/recording_clock.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>

namespace outrider {
namespace {

std::optional<double> length_of(const std::function<double(int)>& time_s, int scans = 100) {
  RecordingClock clock;
  for (int i = 0; i < scans; ++i) clock.note(time_s(i));
  return clock.length_s();
}

TEST(RecordingClock, ADecentClockIsBelieved) {
  EXPECT_DOUBLE_EQ(length_of([](int i) { return 5.0 + 0.5 * i; }).value(), 49.5);
  EXPECT_DOUBLE_EQ(length_of([](int i) { return 0.5 * i; }, 2).value(), 0.5);
  EXPECT_TRUE(length_of([](int i) { return 0.5 * i - (i == 50 ? 0.6 : 0.0); })) << "one scan out of order";
}

TEST(RecordingClock, AClockThatStandsGoesBackOrJumpsIsNot) {
  EXPECT_FALSE(length_of([](int i) { return 1.13486e9 + (i < 60 ? 0.0 : 1e4); })) << "rounded to six digits";
  EXPECT_FALSE(length_of([](int i) { return i < 50 ? 4e6 + i : 1.0 * i; })) << "it wraps";
  EXPECT_FALSE(length_of([](int i) { return i < 50 ? 1.0 * i : 1e9 + i; })) << "it was set";
  EXPECT_FALSE(length_of([](int) { return 3.0; }));
  EXPECT_FALSE(length_of([](int i) { return i == 7 ? std::numeric_limits<double>::quiet_NaN() : 1.0 * i; }));
  EXPECT_FALSE(length_of([](int i) { return 1.0 * i; }, 1));
  EXPECT_FALSE(length_of([](int i) { return 1.0 * i; }, 0));
}

}  // namespace
}  // namespace outrider
