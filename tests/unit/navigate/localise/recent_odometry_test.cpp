#include "outrider/navigate/recent_odometry.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace outrider {
namespace {

constexpr double step_s = 0.05;

Observation odometry_at(double time_s, const Pose2& odometry) {
  Observation seen;
  seen.time_s = time_s;
  seen.odometry = odometry;
  return seen;
}

/// Drives straight ahead at 0.5 m/s from time 0 until then.
RecentOdometry driven(double until_s) {
  RecentOdometry track;
  for (int i = 0; i * step_s <= until_s; ++i)
    track.note(odometry_at(i * step_s, {{0.5 * i * step_s, 0.0}, 0.0}), {0.5, 0.0, 0.0}, {}, step_s);
  return track;
}

TEST(RecentOdometry, TellsWhereTheRobotWasALittleAgo) {
  const RecentOdometry track = driven(2.0);
  EXPECT_NEAR(track.time_s(), 2.0, 1e-9);
  EXPECT_NEAR(track.newest().position.x, 1.0, 1e-9);
  for (const double ago_s : {0.0, 0.02, 0.33, 0.9})
    EXPECT_NEAR(track.at(2.0 - ago_s).position.x, 1.0 - 0.5 * ago_s, 1e-9);
  EXPECT_NEAR(track.at(0.0).position.x, 0.5, 0.05) << "no earlier than it remembers";
  EXPECT_NEAR(track.twist().ahead_mps, 0.5, 0.01);
}

TEST(RecentOdometry, GoesOnWhenTheClockIsPutBack) {
  RecentOdometry track = driven(2.0);
  track.note(odometry_at(-58.0, {{1.025, 0.0}, 0.0}), {0.5, 0.0, 0.0}, {}, step_s);
  EXPECT_NEAR(track.time_s(), 2.05, 1e-9);
  EXPECT_NEAR(track.clock_s(), -58.0, 1e-9);
  EXPECT_NEAR(track.time_of(-57.9), 2.15, 1e-9);
}

TEST(RecentOdometry, TakesAWrappedHeadingForNoWholeTurn) {
  RecentOdometry track;
  track.note(odometry_at(0.0, {{0.0, 0.0}, 3.13}), {}, {}, step_s);
  track.note(odometry_at(step_s, {{0.0, 0.0}, -3.13}), {}, {}, step_s);
  EXPECT_NEAR(track.newest().heading_rad, 2.0 * 3.14159265358979 - 3.13, 1e-9);
  EXPECT_LE(std::abs(track.twist().turn_radps), 1.2 * RobotModel{}.turn_rate_radps);
}

TEST(RecentOdometry, DoesNotNoteWhatMakesNoSense) {
  RecentOdometry track = driven(1.0);
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  track.note(odometry_at(1.05, {{nan, 0.0}, 0.0}), {}, {}, step_s);
  EXPECT_NEAR(track.newest().position.x, 0.5, 1e-9);
  track.note(odometry_at(nan, {{0.6, 0.0}, 0.0}), {}, {}, step_s);
  EXPECT_NEAR(track.time_s(), 1.05, 1e-9);
  track.note(odometry_at(1.1, {{1e300, 0.0}, 0.0}), {}, {}, step_s);
  EXPECT_NEAR(track.newest().position.x, 0.5, 1e-9);
  EXPECT_LE(std::abs(track.twist().ahead_mps), 1.2 * RobotModel{}.speed_mps);
}

}  // namespace
}  // namespace outrider
