#include "outrider/control/steer.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace outrider {
namespace {

RobotModel small_robot() {
  RobotModel robot;
  robot.radius_m = 0.105;
  robot.speed_mps = 0.22;
  robot.acceleration_mps2 = 2.5;
  robot.turn_rate_radps = 2.84;
  robot.turn_acceleration_radps2 = 3.2;
  return robot;
}

/// Free, but for the cells whose centres `blocked` holds of.
template <class Blocked>
Grid<std::uint8_t> map_of(Blocked blocked) {
  Grid<std::uint8_t> map({{-1.0, -1.0}, 0.05, 100, 100}, free_cell);
  for (std::size_t i = 0; i < map.cells.size(); ++i) {
    if (blocked(map.frame.centre(map.frame.cell(i)))) map.cells[i] = occupied_cell;
  }
  return map;
}

struct Drive {
  double time_s = 0.0;
  double least_m = 10.0;  ///< clearance of the middle
  double speed_mps = 0.0;
  Pose2 end;
};

/// The robot follows the path until it rests at its end, with its accelerations in steps of 10 ms.
Drive follow_to_the_end(const Grid<std::uint8_t>& map, PathProgress path, Pose2 pose,
                        const SteerOptions& options = {}) {
  const RobotModel robot = small_robot();
  Drive drive;
  Twist2 twist;
  double driven = 0.0;
  const auto near = [](double from, double to, double most) {
    return from + std::clamp(to - from, -most, most);
  };
  for (int i = 0; i < 1200; ++i) {
    const Nearby nearby(map, pose.position, 0.9);
    advance_along(path, pose.position);
    const Twist2 command = steer(path, pose, twist, nearby, robot, options);
    EXPECT_LE(command.ahead_mps, robot.speed_mps + 1e-12);
    EXPECT_LE(std::abs(command.turn_radps), robot.turn_rate_radps + 1e-12);
    for (int k = 0; k < 5; ++k) {
      twist.ahead_mps = near(twist.ahead_mps, command.ahead_mps, robot.acceleration_mps2 * 0.01);
      twist.turn_radps = near(twist.turn_radps, command.turn_radps, robot.turn_acceleration_radps2 * 0.01);
      pose = moved(pose, twist, 0.015);
      driven += 0.01 * twist.ahead_mps;
      drive.least_m = std::min(drive.least_m, nearby.clearance(pose.position));
    }
    drive.time_s += 0.05;
    if (command == Twist2{} && norm(Vec2{twist.ahead_mps, twist.turn_radps}) < 0.01) break;
  }
  drive.speed_mps = driven / drive.time_s;
  drive.end = pose;
  return drive;
}

TEST(Steer, GoesStraightAtFullSpeed) {
  const Drive drive = follow_to_the_end(map_of([](Vec2) { return false; }), {{{0, 0}, {3, 0}}, 0.0}, {});
  EXPECT_LT(distance(drive.end.position, Vec2{3, 0}), 0.015);
  EXPECT_GT(drive.speed_mps, 0.95 * small_robot().speed_mps);
}

TEST(Steer, TurnsRoundInPlaceFirst) {
  const Drive drive =
      follow_to_the_end(map_of([](Vec2) { return false; }), {{{1, 1}, {0, 1}}, 0.0}, {{1, 1}, 0.2});
  EXPECT_LT(distance(drive.end.position, Vec2{0, 1}), 0.015);
  EXPECT_LT(drive.time_s, 1.0 / 0.22 + 3.0);
}

TEST(Steer, RoundsACornerWithoutTouchingOrStopping) {
  const auto map = map_of([](Vec2 p) { return p.x > 0.15 && p.y < 1.85; });  // the wall stands in the way
  const Drive drive = follow_to_the_end(map, {{{0, 0}, {0, 2}, {2, 2}}, 0.0}, {{0, 0}, pi / 2});
  EXPECT_LT(distance(drive.end.position, Vec2{2, 2}), 0.015);
  EXPECT_GE(drive.least_m, small_robot().radius_m + 0.005);
  EXPECT_GT(drive.speed_mps, 0.85 * small_robot().speed_mps);
}

TEST(Steer, DoesNotDriveIntoWhatStandsOnThePath) {
  const auto map = map_of([](Vec2 p) { return p.x > 1.0; });
  const Drive drive = follow_to_the_end(map, {{{0, 0}, {2, 0}}, 0.0}, {});
  EXPECT_GE(drive.least_m, small_robot().radius_m);
  EXPECT_GT(drive.end.position.x, 0.8);
}

TEST(Steer, LeavesAPlaceThatIsTooNear) {
  const auto map = map_of([](Vec2 p) { return p.x > 0.1; });
  const Drive drive = follow_to_the_end(map, {{{0, 0}, {-1, 0}}, 0.0}, {});
  EXPECT_LT(distance(drive.end.position, Vec2{-1, 0}), 0.015);
}

TEST(PathProgress, NeverGoesBackAndEndsAtItsEnd) {
  PathProgress path{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}, 0.0};
  EXPECT_DOUBLE_EQ(remaining_m(path), 3.0);
  advance_along(path, {0.4, 0.1});
  EXPECT_NEAR(path.along_m, 0.4, 1e-12);
  advance_along(path, {0.1, 0.0});
  EXPECT_NEAR(path.along_m, 0.4, 1e-12);
  advance_along(path, {0.4, 1.0});  // near the last leg, but that is far along the path
  EXPECT_LE(path.along_m, 0.9);
  for (int i = 0; i < 9; ++i) advance_along(path, {-1.0, 1.0});
  EXPECT_LE(remaining_m(path), 2.6);
}

TEST(Steer, DrivesWithTheLeastLookaheadToo) {
  SteerOptions options;
  for (const Option& option : describe(options)) {
    if (option.name == "lookahead") {
      ASSERT_TRUE(assign(option, std::to_string(option.low)));
    }
  }
  const auto map = map_of([](Vec2) { return false; });
  const Drive drive = follow_to_the_end(map, {{{0.0, 0.0}, {0.5, 0.0}}, 0.0}, {}, options);
  EXPECT_LT(distance(drive.end.position, Vec2{0.5, 0.0}), 0.02);
}

}  // namespace
}  // namespace outrider
