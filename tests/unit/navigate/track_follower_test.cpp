// Robots on tracks: how near to them they stay, and what they leave out where something stands.
#include "outrider/navigate/track_follower.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "outrider/motion/limited_twist.hpp"
#include "outrider/navigate/navigator.hpp"
#include "outrider/sim/simulated_robot.hpp"

namespace outrider {
namespace {

/// A lane, a turn in place, a lane, a smooth half circle, a lane, and one backwards.
TrackPieces winding() {
  return {{{0.0, 0.0}, {3.0, 0.0}, {}, 0.0}, {{3.0, 0.0}, {3.0, 1.0}, {}, 0.0},
          {{3.0, 1.0}, {1.0, 1.0}, {}, 0.0}, {{1.0, 1.0}, {1.0, 2.0}, {1.0, 1.5}, -pi},
          {{1.0, 2.0}, {3.0, 2.0}, {}, 0.0}, {{3.0, 2.0}, {2.0, 2.0}, {}, 0.0, true}};
}

RobotModel quick() {
  RobotModel robot;
  robot.radius_m = 0.15;
  robot.speed_mps = 0.6;
  robot.acceleration_mps2 = 1.0;
  robot.turn_rate_radps = 2.0;
  return robot;
}

double to_track_m(const TrackPieces& track, Vec2 place) {
  double least = 1e9;
  for (const PathPiece& piece : track)
    least = std::min(least, distance(place, point_on(piece, nearest_part(piece, place))));
  return least;
}

struct Driven {
  Progress progress;
  double beside_m = 0.0;  // largest true distance from the track
  std::int64_t contacts = 0;
  double time_s = 0.0;
  std::vector<Vec2> way;
  std::vector<TrackSection> left_out;
};

Driven drive(const World& world, const TrackPieces& track, std::optional<AllowedGround> allowed = {}) {
  NavigatorSetup setup;
  setup.robot = quick();
  setup.footprint = Footprint::disk(0.15);
  setup.options.localiser = "odometry";
  setup.allowed = std::move(allowed);
  ExplorerSimParams params;
  params.laser.rate_hz = 20.0;
  params.wheels.scale_error = params.wheels.noise_m = 0.0;
  SimulatedRobot robot = simulated_explorer(world, {}, setup.robot, params, 3);
  auto navigator = Navigator::make(setup, Pose2{});
  const Follow order{std::make_shared<const TrackPieces>(track)};
  Driven driven;
  while (robot.time_s() < 200.0) {
    driven.progress = navigator->perceive(robot.sense()).progress;
    if (driven.progress.state != Progress::State::underway) break;
    robot.act(navigator->act(order));
    driven.way.push_back(robot.pose().position);
    driven.beside_m = std::max(driven.beside_m, to_track_m(track, robot.pose().position));
  }
  driven.contacts = robot.body<TwistBody>().contacts();
  driven.time_s = robot.time_s();
  if (navigator->track() != nullptr) driven.left_out = navigator->track()->left_out();
  return driven;
}

TEST(TrackFollower, StaysOnLegsAndArcsForwardsAndBackwards) {
  const TrackPieces track = winding();
  const Driven driven = drive({}, track);
  EXPECT_EQ(driven.progress.state, Progress::State::arrived);
  EXPECT_LT(driven.beside_m, 0.01);
  EXPECT_TRUE(driven.left_out.empty());
  for (const PathPiece& piece : track) {
    double least = 1e9;
    for (const Vec2 place : driven.way) least = std::min(least, distance(place, piece.to));
    EXPECT_LT(least, 0.02);
  }
  EXPECT_LT(driven.time_s, 35.0);
}

TEST(TrackFollower, BrakesInTimeOverManyShortPieces) {
  TrackPieces track;
  for (int i = 0; i < 40; ++i) track.push_back({{0.25 * i, 0.0}, {0.25 * (i + 1), 0.0}, {}, 0.0});
  RobotModel robot = quick();
  robot.speed_mps = 3.0;
  TrackFollower follower(std::make_shared<const TrackPieces>(track));
  constexpr double period_s = 0.05;
  Pose2 pose;
  Twist2 twist;
  double fastest_mps = 0.0;
  follower.go_on(pose);
  for (int i = 0; i < 400 && !follower.is_done(); ++i) {
    twist = twist_after(twist, follower.twist(pose, robot, period_s, 100.0), robot, period_s);
    pose = moved(pose, twist, period_s);
    fastest_mps = std::max(fastest_mps, twist.ahead_mps);
    follower.note(pose);
  }
  EXPECT_TRUE(follower.is_done());
  EXPECT_GT(fastest_mps, 2.0);
  EXPECT_LT(twist.ahead_mps, 0.2);
  EXPECT_LT(pose.position.x, 10.02);
}

TEST(TrackFollower, GoesAroundWhatStandsOnTheTrackAndSaysWhatItLeftOut) {
  World world;
  world.solids = {{"post", {{1.5, 0.0, 0.5}, {}}, CylinderShape{0.1, 0.5}}};
  const Driven driven = drive(world, winding());
  EXPECT_EQ(driven.progress.state, Progress::State::arrived);
  EXPECT_EQ(driven.contacts, 0);
  ASSERT_EQ(driven.left_out.size(), 1U);
  const auto left = pieces_of(winding(), driven.left_out[0]);
  ASSERT_EQ(left.size(), 1U);
  EXPECT_GT(left[0].from.x, 1.0);
  EXPECT_LT(left[0].from.x, 1.5 - 0.25);
  EXPECT_GT(left[0].to.x, 1.7);
  EXPECT_LT(left[0].to.x, 2.0);
  EXPECT_LT(driven.time_s, 50.0);
}

TEST(TrackFollower, DoesNotLeaveItsGroundToGoAround) {
  World world;
  world.solids = {{"post", {{1.5, 0.0, 0.5}, {}}, CylinderShape{0.1, 0.5}}};
  // On the right of the first lane is no room to pass.
  const AllowedGround ground({{{-1.0, -0.4}, {4.0, -0.4}, {4.0, 3.0}, {-1.0, 3.0}}});
  const Driven driven = drive(world, winding(), ground);
  EXPECT_EQ(driven.progress.state, Progress::State::arrived);
  EXPECT_EQ(driven.contacts, 0);
  EXPECT_EQ(driven.left_out.size(), 1U);
  for (const Vec2 place : driven.way) {
    EXPECT_TRUE(ground.contains(place));
    EXPECT_GT(ground.to_edge_m(place), 0.15) << place.x << ' ' << place.y;
  }
}

TEST(TrackFollower, LeavesOutWhatNoWayLeadsTo) {
  World world;
  const double far = 3.0;
  world.solids = {{"wall", {{2.0, 0.0, 0.5}, {}}, BoxShape{{0.1, far, 0.5}}},
                  {"left", {{0.0, far, 0.5}, {}}, BoxShape{{2.0, 0.1, 0.5}}},
                  {"right", {{0.0, -far, 0.5}, {}}, BoxShape{{2.0, 0.1, 0.5}}},
                  {"behind", {{-2.0, 0.0, 0.5}, {}}, BoxShape{{0.1, far, 0.5}}}};
  const Driven driven = drive(world, {{{0.0, 0.0}, {4.0, 0.0}, {}, 0.0}, {{4.0, 0.0}, {4.0, 1.0}, {}, 0.0}});
  EXPECT_EQ(driven.progress.state, Progress::State::arrived) << driven.time_s;
  EXPECT_EQ(driven.contacts, 0);
  ASSERT_FALSE(driven.left_out.empty());
  EXPECT_EQ(driven.left_out.back().to.piece, 2U);
}

TEST(TrackFollower, TellsPlacesAlongTheTrack) {
  const TrackFollower follower(std::make_shared<const TrackPieces>(winding()));
  const auto place = follower.ahead_of({}, 3.5);
  ASSERT_TRUE(place);
  EXPECT_EQ(place->piece, 1U);
  EXPECT_NEAR(place->part, 0.5, 1e-12);
  EXPECT_FALSE(follower.ahead_of({}, 100.0));
  const Pose2 half = follower.pose_at({3, 0.5});
  EXPECT_NEAR(half.position.x, 0.5, 1e-12);
  EXPECT_NEAR(wrap_angle(half.heading_rad - 0.5 * pi), 0.0, 1e-12);
}

}  // namespace
}  // namespace outrider
