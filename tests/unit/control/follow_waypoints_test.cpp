#include "outrider/control/follow_waypoints.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "outrider/control/timed_drive.hpp"
#include "outrider/core/units.hpp"
#include "outrider/geometry/convex.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

Chassis chassis() { return mecanum_chassis(0.03, 0.1225); }

struct Driven {
  std::vector<Pose2> stops;
  std::vector<Vec2> positions;
  double driven_m = 0.0;
  double turned_rad = 0.0;
  bool all = false;
};

/// A robot that does at once what it is told.
Driven drive(const std::vector<Waypoint>& waypoints, const FollowOptions& options) {
  constexpr double period_s = 0.05;
  Follower follower;
  Pose2 pose;
  Driven driven;
  for (int i = 0; i < 6000; ++i) {
    const FollowStep step = follow(follower, waypoints, pose, options, {}, chassis(), period_s);
    if (step.there) {
      driven.stops.push_back(pose);
      driven.all = follower.next + 1 == waypoints.size();
      if (driven.all) break;
      advance_to_next(follower, waypoints);
      continue;
    }
    pose = moved(pose, step.twist, period_s);
    driven.positions.push_back(pose.position);
    driven.driven_m += period_s * speed_of(step.twist);
    driven.turned_rad += period_s * std::abs(step.twist.turn_radps);
  }
  return driven;
}

const std::vector<Waypoint> square = {{{{1, 0}, 0}}, {{{1, 2}, pi}}, {{{0, 0}, 0}}};

TEST(FollowWaypoints, EveryFollowerAndMannerArrives) {
  for (const char* follower : {"pid", "pure_pursuit", "time_optimal"}) {
    for (const char* mode : {"holonomic", "rotate_then_go"}) {
      FollowOptions options;
      options.follower = follower;
      options.mode = mode;
      ASSERT_TRUE(check(options));
      const Driven driven = drive(square, options);
      ASSERT_TRUE(driven.all) << follower << ' ' << mode;
      for (std::size_t i = 0; i < square.size(); ++i) {
        const Pose2& goal = square[i].pose;
        EXPECT_LE(distance(driven.stops[i].position, goal.position), 2.0 * options.within_m);
        EXPECT_LE(std::abs(wrap_angle(driven.stops[i].heading_rad - goal.heading_rad)), options.within_rad);
      }
      EXPECT_LE(driven.driven_m, 1.01 * (3.0 + std::sqrt(5.0))) << follower << ' ' << mode;
      EXPECT_LE(driven.turned_rad, 1.15 * 2.0 * pi) << follower << ' ' << mode;
    }
  }
}

TEST(FollowWaypoints, HalfTurnsGoAsWritten) {
  for (const double sense : {1.0, -1.0}) {
    Follower follower;
    const std::vector<Waypoint> turn = {{{{0, 0}, sense * pi}}};
    const FollowStep step = follow(follower, turn, {{0, 0}, sense * 1e-3}, {}, {}, chassis(), 0.05);
    EXPECT_GT(sense * step.twist.turn_radps, 0.0);
    Follower other;
    const FollowStep across = follow(other, turn, {{0, 0}, -sense * 1e-3}, {}, {}, chassis(), 0.05);
    EXPECT_GT(sense * across.twist.turn_radps, 0.0);
  }
}

TEST(FollowWaypoints, PassesByWhatIsNoStop) {
  Rng rng(1);
  for (int round = 0; round < testing::cases(10); ++round) {
    for (const char* mode : {"holonomic", "rotate_then_go"}) {
      for (const char* kind : {"pid", "pure_pursuit", "time_optimal"}) {
        FollowOptions options;
        options.mode = mode;
        options.follower = kind;
        const std::vector<Waypoint> way = {{{{1, rng.uniform(-0.5, 0.5)}, 0}, false},
                                           {{{2, rng.uniform(-0.5, 0.5)}, 1}, false},
                                           {{{3, 0}, rng.uniform(-3.0, 3.0)}}};
        const Driven driven = drive(way, options);
        ASSERT_TRUE(driven.all) << mode << ' ' << kind;
        EXPECT_EQ(driven.stops.size(), 1U);
        double length = norm(way[0].pose.position);
        for (std::size_t i = 1; i < 3; ++i)
          length += distance(way[i - 1].pose.position, way[i].pose.position);
        EXPECT_LE(driven.driven_m, 1.1 * length);
      }
    }
  }
}

double nearest(const std::vector<Vec2>& positions, Vec2 to) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec2 p : positions) least = std::min(least, distance(p, to));
  return least;
}

double farthest_from_way(const std::vector<Vec2>& positions, const std::vector<Waypoint>& waypoints) {
  double most = 0.0;
  for (const Vec2 p : positions) {
    double least = std::numeric_limits<double>::infinity();
    Vec2 from;
    for (const Waypoint& waypoint : waypoints) {
      least = std::min(least, distance(p, Segment{from, waypoint.pose.position}));
      from = waypoint.pose.position;
    }
    most = std::max(most, least);
  }
  return most;
}

/// Corners of any angle, and turns on the spot: the robot passes each waypoint within its room and does not
/// wait there. Its room is what an obstacle at the corner leaves.
TEST(FollowWaypoints, PassesSharpCornersNearAndWithoutWaiting) {
  constexpr double step_m = 0.0125;  // of a period at full speed
  Rng rng(3);
  for (int round = 0; round < testing::cases(40); ++round) {
    const double room_m = round % 2 == 0 ? rng.uniform(0.005, 0.08) : 1.0;
    std::vector<Waypoint> way;
    Vec2 at;
    double bearing = 0.0, length = 0.0;
    for (int i = 0; i < 4; ++i) {
      const double leg = rng.uniform(0.4, 1.2);
      if (i > 0) bearing += i == 1 && round % 5 == 0 ? pi : rng.uniform(-pi, pi);
      at = at + leg * direction(bearing);
      way.push_back({{at, rng.uniform(-3.0, 3.0)}, i == 3, room_m});
      length += leg;
    }
    for (const char* mode : {"holonomic", "rotate_then_go"}) {
      for (const char* kind : {"pid", "pure_pursuit", "time_optimal"}) {
        FollowOptions options;
        options.mode = mode;
        options.follower = kind;
        const Driven driven = drive(way, options);
        ASSERT_TRUE(driven.all) << round << ' ' << mode << ' ' << kind;
        EXPECT_LE(driven.driven_m, 1.1 * length) << round << ' ' << mode << ' ' << kind;
        const double most = std::min(room_m, options.pass_m) + step_m;
        for (const Waypoint& waypoint : way)
          EXPECT_LE(nearest(driven.positions, waypoint.pose.position), most)
              << round << ' ' << mode << ' ' << kind;
        EXPECT_LE(farthest_from_way(driven.positions, way), most) << round << ' ' << mode << ' ' << kind;
      }
    }
  }
}

TEST(FollowWaypoints, NeverFasterThanTheLimits) {
  for (const char* kind : {"pid", "pure_pursuit", "time_optimal"}) {
    FollowOptions options;
    options.follower = kind;
    Follower follower;
    Twist2 last;
    Pose2 pose;
    for (int i = 0; i < 400; ++i) {
      const Twist2 twist = follow(follower, {{{{5, 3}, 2}}}, pose, options, {}, chassis(), 0.05).twist;
      EXPECT_LE(speed_of(twist), options.speed_mps + 1e-12);
      EXPECT_LE(std::abs(twist.turn_radps), options.turn_rate_radps + 1e-12);
      // That of the velocity in the world, or in the robot's frame.
      const Vec2 before = {last.ahead_mps, last.left_mps}, now = {twist.ahead_mps, twist.left_mps};
      const double turned = options.follower == "time_optimal" ? last.turn_radps * 0.05 : 0.0;
      EXPECT_LE(norm(now - unrotated(turned, before)), 0.05 * options.acceleration_mps2 + 1e-12);
      last = twist;
      pose = moved(pose, twist, 0.05);
    }
  }
}

/// A robot that does at once what it is told takes little more than the ideal time, and stays near the path.
TEST(FollowWaypoints, TimeOptimalComesNearTheIdealTime) {
  Rng rng(4);
  for (int round = 0; round < testing::cases(20); ++round) {
    FollowOptions options;
    options.follower = "time_optimal";
    options.mode = round % 2 == 0 ? "holonomic" : "rotate_then_go";
    std::vector<Waypoint> way;
    Vec2 at;
    for (int i = 0; i < 5; ++i) {
      at = at + rng.uniform(0.4, 1.2) * direction(rng.uniform(-1.2, 1.2));
      way.push_back({{at, rng.uniform(-1.0, 1.0)}, i == 2 || i == 4});
    }
    const Driven driven = drive(way, options);
    ASSERT_TRUE(driven.all) << round;
    const double time_s = 0.05 * static_cast<double>(driven.positions.size());
    const double ideal_s = ideal_time_s({}, way, options, chassis(), 0.0);
    EXPECT_LE(time_s, 1.05 * ideal_s + 1.0) << round;
    EXPECT_GE(time_s, 0.98 * ideal_s - 0.1) << round;
  }
}

TEST(FollowWaypoints, RefusesNamesThatAreNone) {
  FollowOptions options;
  options.follower = "pidd";
  ASSERT_FALSE(check(options));
  EXPECT_NE(to_string(check(options).error()).find("did you mean 'pid'"), std::string::npos);
}

TEST(TimedDrive, BringsACalibratedRobotToEachWaypoint) {
  Rng rng(2);
  for (int round = 0; round < testing::cases(50); ++round) {
    Calibration calibration;
    for (DirectionLaw& law : calibration.laws) law.dead_time_s = rng.uniform(0.0, 0.3);
    std::vector<Pose2> goals;
    for (int i = 0; i < 4; ++i) goals.push_back({testing::random_point(rng, 3.0), rng.uniform(-pi, pi)});
    Pose2 pose{testing::random_point(rng, 3.0), rng.uniform(-pi, pi)};
    std::size_t reached = 0;
    for (const TimedMotion& motion : timed_drive(pose, goals, {}, calibration)) {
      const DirectionLaw& law = motion.twist.turn_radps != 0.0
                                    ? turn_law(calibration, motion.twist.turn_radps)
                                    : ahead_law(calibration, 1.0);
      if (motion.duration_s > 0.0) pose = moved(pose, motion.twist, motion.duration_s - law.dead_time_s);
      if (!motion.at_waypoint) continue;
      EXPECT_NEAR(distance(pose.position, goals[reached].position), 0.0, 1e-9);
      EXPECT_NEAR(wrap_angle(pose.heading_rad - goals[reached].heading_rad), 0.0, 1e-9);
      ++reached;
    }
    EXPECT_EQ(reached, goals.size());
  }
}

}  // namespace
}  // namespace outrider
