#include "outrider/robot/steady_time.hpp"

#include <gtest/gtest.h>

namespace outrider {
namespace {

/// Observations every 0.1 s by a clock that jumps at 2 s; each brings a scan that was measured 0.3 s before.
TEST(SteadyTime, GoesOnThroughAJump) {
  for (const double jump_s : {-100.0, -1.0, 0.0, 2.5, 1000.0}) {
    SteadyTime time;
    const auto shown = [&](double true_s) { return true_s < 2.0 - 1e-6 ? true_s : true_s + jump_s; };
    for (int i = 0; i < 50; ++i) {
      const double true_s = 0.1 * i;
      Observation seen;
      seen.time_s = shown(true_s);
      seen.scan = LaserScan{};
      seen.scan->time_s = shown(true_s - 0.3);
      const Observation steady = time.steady(seen);
      EXPECT_NEAR(steady.time_s, true_s, 1e-9) << jump_s;
      EXPECT_NEAR(steady.scan->time_s, true_s - 0.3, 1e-9) << jump_s << " at " << true_s;
      const Command command = time.on_clock(DriveTwist{{}, steady.time_s + 0.1});
      EXPECT_NEAR(std::get<DriveTwist>(command).until_s, seen.time_s + 0.1, 1e-9);
    }
    EXPECT_EQ(time.jumps(), jump_s == 0.0 ? 0 : 1);
  }
}

TEST(SteadyTime, ALittleLaterThanExpectedIsNoJump) {
  SteadyTime time;
  Observation seen;
  seen.time_s = 1.0;
  EXPECT_EQ(time.steady(seen).time_s, 1.0);
  time.on_clock(DriveTwist{{}, 1.1});
  seen.time_s = 2.5;
  EXPECT_EQ(time.steady(seen).time_s, 2.5);
  EXPECT_EQ(time.jumps(), 0);
}

}  // namespace
}  // namespace outrider
