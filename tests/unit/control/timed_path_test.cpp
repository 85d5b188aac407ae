#include "outrider/control/timed_path.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "outrider/core/units.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

std::vector<Waypoint> random_way(Rng& rng) {
  std::vector<Waypoint> way;
  Vec2 at;
  double bearing = rng.uniform(-pi, pi);
  const std::size_t legs = 1 + rng.below(4);
  for (std::size_t i = 0; i < legs; ++i) {
    at = at + rng.uniform(0.1, 1.0) * direction(bearing);
    bearing += rng.uniform(-pi, pi);
    way.push_back({{at, rng.uniform(-pi, pi)}, i + 1 == legs, rng.uniform(0.0, 0.1)});
  }
  return way;
}

Chassis chassis_for(const FollowOptions& options) {
  return options.mode == "holonomic" ? mecanum_chassis(0.03, 0.1225) : differential_chassis(0.03, 0.1225);
}

/// Speeds and accelerations by differences of poses that are close in time.
TEST(TimedPath, KeepsTheLimits) {
  Rng rng(1);
  for (int round = 0; round < testing::cases(30); ++round) {
    for (const char* mode : {"holonomic", "rotate_then_go"}) {
      FollowOptions options;
      options.mode = mode;
      const auto way = random_way(rng);
      const Pose2 start{{0, 0}, rng.uniform(-pi, pi)};
      const TimedPath path = timed_path_to_stop(start, way, 0, options, chassis_for(options));
      constexpr double step_s = 0.02;
      Vec2 before;
      double before_radps = 0.0;
      for (double t = -step_s; t < path.duration_s + 2.0 * step_s; t += step_s) {
        const Pose2 a = pose_at(path, t), b = pose_at(path, t + step_s);
        const Vec2 velocity = (1.0 / step_s) * (b.position - a.position);
        const double radps = (b.heading_rad - a.heading_rad) / step_s;
        EXPECT_LE(norm(velocity), options.speed_mps + 1e-9);
        EXPECT_LE(norm(velocity - before), 1.1 * options.acceleration_mps2 * step_s + 2e-3) << t;
        if (options.mode == "rotate_then_go") {
          // The limit holds at the points of the path; between two whose curvatures are as 1 to 2, the
          // product of mean speed and mean curvature is 9/8 of it.
          EXPECT_LE(std::abs(radps), 1.125 * options.turn_rate_radps) << t;
          EXPECT_LE(std::abs(radps - before_radps), 1.5 * options.turn_acceleration_radps2 * step_s + 0.05)
              << t;
          const Vec2 across = unrotated(0.5 * (a.heading_rad + b.heading_rad), velocity);
          EXPECT_LE(std::abs(across.y), 0.05 * norm(velocity) + 2e-3) << "it points along the path";
        }
        before = velocity;
        before_radps = radps;
      }
    }
  }
}

TEST(TimedPath, StartsAndEndsWhereItShouldAndPassesWithinTheRoom) {
  Rng rng(2);
  for (int round = 0; round < testing::cases(50); ++round) {
    for (const char* mode : {"holonomic", "rotate_then_go"}) {
      FollowOptions options;
      options.mode = mode;
      const auto way = random_way(rng);
      const Pose2 start{{0, 0}, rng.uniform(-pi, pi)};
      const TimedPath path = timed_path_to_stop(start, way, 0, options, chassis_for(options));
      EXPECT_EQ(pose_at(path, -1.0).position, start.position);
      const Pose2 end = pose_at(path, path.duration_s + 1.0);
      EXPECT_NEAR(distance(end.position, way.back().pose.position), 0.0, 1e-9);
      if (options.mode == "rotate_then_go") {
        EXPECT_NEAR(wrap_angle(end.heading_rad - way.back().pose.heading_rad), 0.0, 1e-9);
      }
      for (const Waypoint& waypoint : way) {
        double least = 10.0;
        for (double t = 0.0; t <= path.duration_s + 0.01; t += 0.01)
          least = std::min(least, distance(pose_at(path, t).position, waypoint.pose.position));
        EXPECT_LE(least, std::min(waypoint.room_m, options.pass_m) + 2.5e-3);
      }
    }
  }
}

TEST(TimedPath, TheIdealTimeOfStraightLegsIsKnown) {
  const FollowOptions options;  // 0.25 m/s, 0.5 m/s^2: 0.5 s more than at full speed
  const std::vector<Waypoint> way = {{{{0, 0}, 0}}, {{{1, 0}, 0}}, {{{1, 2}, pi}}, {{{0, 0}, 0}}};
  const double legs_s = (1.0 + 2.0 + std::sqrt(5.0)) / 0.25 + 3.0 * 0.5;
  const Chassis chassis = mecanum_chassis(0.03, 0.1225);
  EXPECT_NEAR(ideal_time_s({}, way, options, chassis, 0.5), legs_s + 4.0 * 0.5, 0.01);
  const std::vector<Waypoint> turn = {{{{0.1, 0}, pi}}};  // the turn takes longer: 0.8 rad/s, 2 rad/s^2
  EXPECT_NEAR(ideal_time_s({}, turn, options, chassis, 0.0), pi / 0.8 + 0.4, 1e-9);
  FollowOptions rotating;
  rotating.mode = "rotate_then_go";
  const double turns_s = 2.0 * (0.5 * pi / 0.8 + 0.4);
  EXPECT_NEAR(ideal_time_s({}, {{{{0, 1}, 0}}}, rotating, differential_chassis(0.03, 0.1225), 0.0),
              turns_s + 1.0 / 0.25 + 0.5, 0.01);
}

/// A slower wheel makes it slower, more room makes it faster, and no course is faster than at full speed.
TEST(TimedPath, TheIdealTimeFollowsTheLimits) {
  Rng rng(3);
  for (int round = 0; round < testing::cases(20); ++round) {
    FollowOptions options;
    options.mode = round % 2 == 0 ? "holonomic" : "rotate_then_go";
    auto way = random_way(rng);
    for (Waypoint& waypoint : way) waypoint.room_m = 0.02;
    const Chassis chassis = chassis_for(options);
    const double time_s = ideal_time_s({}, way, options, chassis, 0.0);
    FollowOptions slow = options;
    slow.wheel_speed_radps = 5.0;
    EXPECT_GE(ideal_time_s({}, way, slow, chassis, 0.0), time_s);
    auto roomy = way;
    for (Waypoint& waypoint : roomy) waypoint.room_m = 0.06;
    EXPECT_LE(ideal_time_s({}, roomy, options, chassis, 0.0), time_s + 0.01);
    double length_m = 0.0;
    Vec2 from;
    for (const Waypoint& waypoint : way) {
      length_m += distance(from, waypoint.pose.position);
      from = waypoint.pose.position;
    }
    EXPECT_GE(time_s, 0.9 * length_m / options.speed_mps);
  }
}

}  // namespace
}  // namespace outrider
