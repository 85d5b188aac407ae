#include "outrider/nodes/missions/piece_driver.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <deque>

#include "outrider/core/rng.hpp"
#include "outrider/core/units.hpp"
#include "outrider/path/pieces.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

struct Driven {
  double time_s = 0.0;
  double off_m = 0.0;  ///< largest distance from the piece while it drove along it
  Pose2 end;
};

/// Drives a robot that obeys 0.1 s late, in steps of 10 ms.
Driven drive(const FollowPiece& command, Pose2 pose, const Pace& pace, bool turns) {
  PieceDriver driver(pace, turns);
  driver.begin(command, 0.0);
  std::deque<Twist2> late(10);
  Driven driven;
  for (double time_s = 0.0; time_s < 200.0; time_s += 0.01) {
    const auto twist = driver.twist(time_s, pose);
    if (driver.drives()) driven.off_m = std::max(driven.off_m, driver.distance_from(pose.position));
    if (twist) {
      EXPECT_LE(std::abs(twist->ahead_mps), pace.speed_mps + 1e-9);
      EXPECT_LE(std::abs(twist->turn_radps), pace.turn_rate_radps + 1e-9);
    }
    late.push_back(twist.value_or(Twist2{}));
    pose = moved(pose, late.front(), 0.01);
    late.pop_front();
    driven.time_s = time_s;
    if (!twist && late.front() == Twist2{}) break;
  }
  driven.end = pose;
  return driven;
}

Pace pace_of(double speed_mps) {
  Pace pace;
  pace.speed_mps = speed_mps;
  return pace;
}

TEST(PieceDriver, DrivesALegFromAnyHeadingAndStopsAtItsEnd) {
  Rng rng = Rng(2).child("legs");
  for (int i = 0; i < testing::cases(100); ++i) {
    FollowPiece command;
    command.piece.from = testing::random_point(rng, 3.0);
    command.piece.to = testing::random_point(rng, 3.0);
    command.pause_s = rng.uniform(0.0, 1.0);
    const Pace pace = pace_of(rng.uniform(0.1, 0.6));
    const Driven driven = drive(command, {command.piece.from, rng.uniform(-4.0, 4.0)}, pace, true);
    ASSERT_LT(driven.time_s, 199.0) << i;
    ASSERT_LT(driven.off_m, 0.02) << i;
    ASSERT_LT(distance(driven.end.position, command.piece.to), 0.02) << i;
    ASSERT_GT(driven.time_s, length_of(command.piece) / pace.speed_mps + command.pause_s) << i;
  }
}

TEST(PieceDriver, DrivesArcsOfARobotThatSteersForwardsAndBackwards) {
  Rng rng = Rng(3).child("arcs");
  for (int i = 0; i < testing::cases(100); ++i) {
    FollowPiece command;
    const double radius_m = rng.uniform(0.5, 3.0), begin_rad = rng.uniform(-3.0, 3.0);
    command.piece.turn_rad = rng.uniform(0.3, 5.5) * (rng.below(2) == 0 ? 1.0 : -1.0);
    command.piece.from = radius_m * direction(begin_rad);
    command.piece.to = radius_m * direction(begin_rad + command.piece.turn_rad);
    command.piece.backward = rng.below(2) == 0;
    const Driven driven = drive(command, {command.piece.from, heading_in(command.piece)},
                                pace_of(rng.uniform(0.1, 0.6)), false);
    ASSERT_LT(driven.time_s, 199.0) << i;
    ASSERT_LT(driven.off_m, 0.06) << i;
    ASSERT_LT(distance(driven.end.position, command.piece.to), 0.06) << i;
    ASSERT_LT(std::abs(wrap_angle(driven.end.heading_rad - heading_out(command.piece))), 0.15) << i;
  }
}

TEST(PieceDriver, ComesBackToALegThatItBeginsBeside) {
  FollowPiece command;
  command.piece.to = {4.0, 0.0};
  const Driven driven = drive(command, {{0.0, 0.1}, 0.0}, pace_of(0.3), true);
  EXPECT_LT(std::abs(driven.end.position.y), 0.005);
}

}  // namespace
}  // namespace outrider
