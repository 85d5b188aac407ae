#include "outrider/nodes/missions/slowed_clock.hpp"

#include <gtest/gtest.h>

namespace outrider {
namespace {

TEST(SlowedClock, PassesLikeTimeUntilItIsSlowed) {
  SlowedClock clock;
  clock.begin(100.0);
  for (int i = 1; i <= 10; ++i) clock.advance(100.0 + 0.1 * i, 1.0);
  EXPECT_NEAR(clock.time_s(), 1.0, 1e-9);
  EXPECT_EQ(clock.rate(), 1.0);
  EXPECT_NEAR(clock.time_at(100.55), 0.55, 1e-9);
  EXPECT_NEAR(clock.time_at(99.0), -1.0, 1e-9);
  EXPECT_NEAR(clock.time_at(105.0), 1.0, 1e-9);
}

/// Measurements taken while it stood have the time at which it stopped.
TEST(SlowedClock, StandsAndGoesOn) {
  SlowedClock clock;
  clock.begin(0.0);
  clock.advance(1.0, -2.0);  // the rate is 0 from now on, since the last second counted in full
  EXPECT_EQ(clock.rate(), 0.0);
  clock.advance(4.0, 0.25);
  EXPECT_NEAR(clock.time_s(), 1.0, 1e-9);
  EXPECT_EQ(clock.rate(), 0.75);
  clock.advance(6.0, 1.0);
  EXPECT_NEAR(clock.time_s(), 2.5, 1e-9);
  EXPECT_EQ(clock.rate(), 1.0);
  EXPECT_NEAR(clock.time_at(3.0), 1.0, 1e-9);
  EXPECT_NEAR(clock.time_at(5.0), 1.75, 1e-9);
}

}  // namespace
}  // namespace outrider
