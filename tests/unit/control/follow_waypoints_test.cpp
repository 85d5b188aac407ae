#include "outrider/control/follow_waypoints.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "outrider/control/timed_drive.hpp"
#include "outrider/core/units.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

struct Driven {
  std::vector<Pose2> stops;
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
    const FollowStep step = follow(follower, waypoints, pose, options, {}, period_s);
    if (step.there) {
      driven.stops.push_back(pose);
      driven.all = follower.next + 1 == waypoints.size();
      if (driven.all) break;
      advance_to_next(follower, waypoints);
      continue;
    }
    pose = moved(pose, step.twist, period_s);
    driven.driven_m += period_s * speed_of(step.twist);
    driven.turned_rad += period_s * std::abs(step.twist.turn_radps);
  }
  return driven;
}

const std::vector<Waypoint> square = {{{{1, 0}, 0}}, {{{1, 2}, pi}}, {{{0, 0}, 0}}};

TEST(FollowWaypoints, EveryFollowerAndMannerArrives) {
  for (const char* follower : {"pid", "pure_pursuit"}) {
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
    const FollowStep step = follow(follower, turn, {{0, 0}, sense * 1e-3}, {}, {}, 0.05);
    EXPECT_GT(sense * step.twist.turn_radps, 0.0);
    Follower other;
    const FollowStep across = follow(other, turn, {{0, 0}, -sense * 1e-3}, {}, {}, 0.05);
    EXPECT_GT(sense * across.twist.turn_radps, 0.0);
  }
}

TEST(FollowWaypoints, PassesByWhatIsNoStop) {
  Rng rng(1);
  for (int round = 0; round < testing::cases(10); ++round) {
    for (const char* mode : {"holonomic", "rotate_then_go"}) {
      for (const char* kind : {"pid", "pure_pursuit"}) {
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

TEST(FollowWaypoints, NeverFasterThanTheLimits) {
  FollowOptions options;
  Follower follower;
  Twist2 last;
  Pose2 pose;
  for (int i = 0; i < 400; ++i) {
    const Twist2 twist = follow(follower, {{{{5, 3}, 2}}}, pose, options, {}, 0.05).twist;
    EXPECT_LE(speed_of(twist), options.speed_mps + 1e-12);
    EXPECT_LE(std::abs(twist.turn_radps), options.turn_rate_radps + 1e-12);
    EXPECT_LE(speed_of(twist + -1.0 * last), 0.05 * options.acceleration_mps2 + 1e-12);
    last = twist;
    pose = moved(pose, twist, 0.05);
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
