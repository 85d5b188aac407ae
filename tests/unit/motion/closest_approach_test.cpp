#include "outrider/motion/closest_approach.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "outrider/motion/profile.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

using testing::cases;

/// Returns the place of a robot, by the functions that move simulated robots.
Vec2 own_place_at(const RobotModel& robot, const TimedDrives& driven, double time_s) {
  Pose2 pose = driven.start;
  for (const TimedDrive& drive : driven.drives) {
    double begin_s = drive.begin_s;
    if (time_s >= begin_s) pose.heading_rad = drive.heading_rad.value_or(pose.heading_rad);
    for (std::size_t k = 1; k < drive.waypoints.size(); ++k) {
      const Vec2 from = drive.waypoints[k - 1], to = drive.waypoints[k];
      const double length = distance(from, to);
      begin_s += duration(std::abs(wrap_angle(heading_of(to - from) - pose.heading_rad)), robot.turning());
      pose.heading_rad = heading_of(to - from);
      if (time_s < begin_s) return from;
      const double after_s = time_s - begin_s;
      if (after_s < duration(length, robot.straight()))
        return from + covered(length, robot.straight(), after_s) / length * (to - from);
      begin_s += duration(length, robot.straight());
      pose.position = to;
    }
  }
  return pose.position;
}

TimedDrives random_drives(Rng& rng, const RobotModel& robot) {
  const auto place = [&] { return Vec2{rng.uniform(-3.0, 3.0), rng.uniform(-3.0, 3.0)}; };
  TimedDrives driven{{place(), rng.uniform(-pi, pi)}, {}};
  Pose2 pose = driven.start;
  double time_s = 0.0;
  for (std::size_t drives = 1 + rng.below(3); drives > 0; --drives) {
    TimedDrive drive{time_s + rng.uniform(0.0, 2.0), {pose.position}};
    for (std::size_t legs = 1 + rng.below(3); legs > 0; --legs) drive.waypoints.push_back(place());
    if (rng.below(2) == 0) drive.heading_rad = pose.heading_rad + rng.uniform(-0.2, 0.2);
    const double heading_rad = drive.heading_rad.value_or(pose.heading_rad);
    const DriveCost cost = drive_cost(robot, heading_rad, drive.waypoints);
    time_s = drive.begin_s + cost.time_s;
    pose = {drive.waypoints.back(), cost.heading_rad};
    driven.drives.push_back(std::move(drive));
  }
  return driven;
}

TEST(ClosestApproach, IsThatOfFineSteps) {
  const RobotModel robot;
  Rng rng(11);
  for (int i = 0; i < cases(60); ++i) {
    const std::vector<TimedDrives> robots{random_drives(rng, robot), random_drives(rng, robot),
                                          random_drives(rng, robot)};
    const auto nearest = closest_approach(robot, robots);
    ASSERT_TRUE(nearest) << nearest.error().sentence;
    const auto apart = [&](std::size_t one, std::size_t other, double time_s) {
      return distance(own_place_at(robot, robots[one], time_s), own_place_at(robot, robots[other], time_s));
    };
    EXPECT_NEAR(apart(nearest->one, nearest->other, nearest->time_s), nearest->distance_m, 1e-6);
    constexpr double step_s = 0.01;
    double sampled = apart(0, 1, 0.0);
    for (double time_s = 0.0; time_s < 120.0; time_s += step_s) {
      for (const auto& [one, other] : {std::pair{0, 1}, {0, 2}, {1, 2}})
        sampled =
            std::min(sampled, apart(static_cast<std::size_t>(one), static_cast<std::size_t>(other), time_s));
    }
    EXPECT_GE(sampled, nearest->distance_m - 1e-6);
    EXPECT_LE(sampled, nearest->distance_m + robot.speed_mps * step_s);
  }
}

TEST(ClosestApproach, OfRobotsThatCrossOnStraightLines) {
  const RobotModel robot;
  // Both are in the middle of their legs at the same time; a second later the other is past it.
  const TimedDrives one{{{-2, 0}, 0.0}, {{0.0, {{-2, 0}, {2, 0}}}}};
  TimedDrives other{{{0, -2}, pi / 2}, {{0.0, {{0, -2}, {0, 2}}}}};
  const auto meets = closest_approach(robot, {one, other});
  ASSERT_TRUE(meets);
  EXPECT_NEAR(meets->distance_m, 0.0, 1e-6);
  EXPECT_NEAR(meets->time_s, 0.5 * duration(4.0, robot.straight()), 1e-6);
  other.drives[0].begin_s = 1.0;
  const auto passes = closest_approach(robot, {one, other});
  ASSERT_TRUE(passes);
  // Both at full speed: the distance is 0.8 m / sqrt(2) when each is as far from the middle.
  EXPECT_NEAR(passes->distance_m, robot.speed_mps / std::sqrt(2.0), 1e-9);
}

TEST(ClosestApproach, OfStandingRobotsAndOfOne) {
  const RobotModel robot;
  const auto alone = closest_approach(robot, {{{{1, 2}, 0.0}, {}}});
  ASSERT_TRUE(alone);
  EXPECT_TRUE(std::isinf(alone->distance_m));
  const auto standing = closest_approach(robot, {{{{0, 0}, 0.0}, {}}, {{{3, 4}, 0.0}, {}}});
  ASSERT_TRUE(standing);
  EXPECT_EQ(standing->distance_m, 5.0);
  EXPECT_EQ(standing->time_s, 0.0);
  EXPECT_EQ(standing->one, 0U);
  EXPECT_EQ(standing->other, 1U);
}

TEST(ClosestApproach, RefusesDrivesThatNoRobotMakes) {
  const RobotModel robot;
  const auto sentence = [&](const TimedDrives& wrong) {
    const auto refused = closest_approach(robot, {{{{9, 9}, 0.0}, {}}, wrong});
    return refused ? std::string() : refused.error().sentence;
  };
  EXPECT_EQ(sentence({{{0, 0}, 0.0}, {{0.0, {{0, 1}, {1, 1}}}}}),
            "drive 1 of robot 2 begins elsewhere than the robot stands");
  EXPECT_EQ(sentence({{{0, 0}, 0.0}, {{0.0, {{0, 0}, {1, 0}}}, {1.0, {{1, 0}, {2, 0}}}}}),
            "drive 2 of robot 2 begins before the one before has ended");
  EXPECT_EQ(sentence({{{0, 0}, 0.0}, {{std::nan(""), {{0, 0}, {1, 0}}}}}),
            "drive 1 of robot 2 has a number that is not finite");
  EXPECT_EQ(sentence({{{0, 0}, 0.0}, {{0.0, {{0, 0}, {1, 0}}, std::nan("")}}}),
            "drive 1 of robot 2 has a number that is not finite");
}

/// A robot that ends a drive with an error of the heading turns less, or more, before the next one.
TEST(ClosestApproach, TakesTheHeadingOfEachDrive) {
  const RobotModel robot;
  const double leg_s = duration(1.0, robot.straight());
  const double turn_s = duration(pi / 2 - 0.1, robot.turning());
  TimedDrives driven{{{0, 0}, 0.0}, {{0.0, {{0, 0}, {1, 0}}}, {leg_s, {{1, 0}, {1, 1}}, 0.1}}};
  driven.drives.push_back({leg_s + turn_s + leg_s, {{1, 1}, {1, 2}}});
  const TimedDrives stands{{{9, 9}, 0.0}, {}};
  EXPECT_TRUE(closest_approach(robot, {driven, stands}));
  driven.drives[1].heading_rad.reset();
  EXPECT_FALSE(closest_approach(robot, {driven, stands}));
}

}  // namespace
}  // namespace outrider
