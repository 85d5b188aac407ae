#include "outrider/jobs/guard/run/robot.hpp"

#include <gtest/gtest.h>

#include <array>

#include "outrider/log/append.hpp"
#include "outrider/log/messages/gun_messages.hpp"
#include "outrider/log/topics.hpp"
#include "support/costly_cases.hpp"
#include "support/planned_yard.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

using testing::box_at;
using testing::cases;
using testing::firing_map_of;
using testing::floor_at;
using testing::own_duration;
using testing::random_guard_problem;

Vec3 vec3_of(const auto& v) { return {v.x, v.y, v.z}; }

GuardProblem one_target() {
  GuardProblem problem;
  problem.world.bounds = {{-5, -5}, {5, 5}};
  problem.world.solids = {floor_at(0)};
  problem.start = {{0, 0}, 0.0};
  problem.targets = {{"cat", {3, 0, 0}, {0.5, 0.3, 0.4}, 0.3}};
  return problem;
}

TEST(SimulatedGuard, ArrivesUniformlyWithinTheErrors) {
  const GuardProblem problem = one_target();
  const FiringMap firing_map = firing_map_of(problem, {.resolution_m = 0.25});
  Log log;
  auto robot = simulated_guard(problem, firing_map, log, 5);
  const int drives = 4000;
  std::array<int, 4> rings{};
  std::array<int, 4> quadrants{};
  double heading_sum = 0.0;
  double heading_most = 0.0;
  for (int i = 0; i < drives; ++i) {
    const Vec2 from = robot.sense().odometry.position;
    const Vec2 goal{i % 2 == 0 ? 2.0 : -2.0, 0.0};
    robot.act(FollowWaypoints{{from, goal}});
    const Pose2 pose = robot.sense().odometry;
    const Vec2 error = pose.position - goal;
    ASSERT_LE(norm(error), problem.errors.position_m + 1e-12);
    const double off = wrap_angle(pose.heading_rad - heading_of(pose.position - from));
    ASSERT_LE(std::abs(off), problem.errors.heading_rad + 1e-12);
    heading_sum += off;
    heading_most = std::max(heading_most, std::abs(off));
    const double part = squared_norm(error) / (problem.errors.position_m * problem.errors.position_m);
    ++rings[static_cast<std::size_t>(std::min(3.0, 4.0 * part))];  // rings of equal area
    ++quadrants[(error.x > 0.0 ? 1U : 0U) + (error.y > 0.0 ? 2U : 0U)];
  }
  // 1000 each with a standard deviation of 27.
  for (const int count : rings) EXPECT_NEAR(count, 1000, 110);
  for (const int count : quadrants) EXPECT_NEAR(count, 1000, 110);
  EXPECT_NEAR(heading_sum / drives, 0.0, 2e-4);
  EXPECT_GT(heading_most, 0.99 * problem.errors.heading_rad);
}

/// A drive ends with an error of the heading. The next one begins with it, and the log says so.
TEST(SimulatedGuard, LogsWhereADriveBegins) {
  GuardProblem problem = one_target();
  problem.errors.heading_rad = 0.2;
  const FiringMap firing_map = firing_map_of(problem, {.resolution_m = 0.25});
  Log log;
  auto robot = simulated_guard(problem, firing_map, log, 5);
  robot.act(FollowWaypoints{{{0.0, 0.0}, {1.0, 0.0}}});
  for (int i = 0; i < 4; ++i) {
    const auto before = robot.sense();
    const std::size_t rows = poses_of(log).size();
    ASSERT_NE(before.odometry.heading_rad, poses_of(log).back().heading_rad) << "no error to tell of";
    robot.act(FollowWaypoints{{before.odometry.position, {i % 2 == 0 ? 2.0 : -2.0, 0.5 * i}}});
    const auto poses = poses_of(log);
    ASSERT_GT(poses.size(), rows);
    EXPECT_EQ(poses[rows].position, before.odometry.position);
    EXPECT_NEAR(wrap_angle(poses[rows].heading_rad - before.odometry.heading_rad), 0.0, 1e-12);
  }
}

TEST(SimulatedGuard, NeverArrivesInsideAnObstacle) {
  Rng rng(101);
  for (int i = 0; i < cases(5); ++i) {
    const auto problem = random_guard_problem(rng, 10, 0, 2.0);
    const FiringMap firing_map = firing_map_of(problem, {.resolution_m = 0.25});
    Log log;
    auto robot = simulated_guard(problem, firing_map, log, static_cast<std::uint64_t>(i));
    for (int k = 0; k < 300; ++k) {
      const std::size_t cell = rng.below(firing_map.frame.size());
      const Vec2 goal = firing_map.frame.centre(firing_map.frame.cell(cell));
      const Vec2 here = robot.sense().odometry.position;
      if (firing_map.reachable[cell] == 0 ||
          !firing_map.ground.segment_free({here, goal}, problem.robot.radius_m))
        continue;
      robot.act(FollowWaypoints{{here, goal}});
      EXPECT_GE(firing_map.ground.clearance(robot.sense().odometry.position, 1.0),
                problem.robot.radius_m - 2e-9);
    }
    for (const Pose2& pose : poses_of(log)) {
      EXPECT_GE(firing_map.ground.clearance(pose.position, 1.0), problem.robot.radius_m - 2e-9);
    }
  }
}

TEST(SimulatedGuard, MovesAsItsModelAndAddsItUp) {
  GuardProblem problem = one_target();
  problem.errors = {0.0, 0.0, {0.0, 0.0}};
  const FiringMap firing_map = firing_map_of(problem, {.resolution_m = 0.25});
  Log log;
  auto robot = simulated_guard(problem, firing_map, log, 1);
  const std::vector<Vec2> way{{0, 0}, {0.3, 0.3}, {0.3, 3.0}, {-2.0, 3.0}, {-2.0, -1.0}};
  robot.act(FollowWaypoints{way});
  double time = 0.0;
  double driven = 0.0;
  double turned = 0.0;
  double heading = 0.0;
  for (std::size_t i = 1; i < way.size(); ++i) {
    const Vec2 leg = way[i] - way[i - 1];
    const double turn = testing::own_angle(std::atan2(leg.y, leg.x) - heading);
    time += own_duration(turn, 0.8, 6.0) + own_duration(norm(leg), 0.8, 0.8);
    turned += turn;
    driven += norm(leg);
    heading = std::atan2(leg.y, leg.x);
  }
  EXPECT_NEAR(robot.sense().time_s, time, 1e-9);
  EXPECT_NEAR(robot.record.driven_m, driven, 1e-9);
  EXPECT_NEAR(robot.record.turned_rad, turned, 1e-9);
  EXPECT_EQ(robot.sense().odometry.position, way.back());
  const auto& plans = log.messages<nav_msgs::Path>(topic::plan);
  ASSERT_EQ(plans.size(), 2U);
  EXPECT_EQ(plans[0].message.poses.size(), way.size());
  EXPECT_TRUE(plans[1].message.poses.empty()) << "the drive is over";
  EXPECT_NEAR(plans[1].time_s(), time, 1e-9);

  // Between samples: time goes on, speeds and accelerations stay within the limits.
  const auto& track = log.messages<geometry_msgs::PoseStamped>(topic::pose);
  const auto poses = poses_of(log);
  double before = 0.0;
  for (std::size_t i = 1; i < track.size(); ++i) {
    constexpr double rounded_s = 1e-9;  // the times in a log are whole nanoseconds
    const double dt = seconds(track[i].time_ns - track[i - 1].time_ns) + rounded_s;
    ASSERT_GE(dt, rounded_s);
    EXPECT_LE(dt, 0.1 + 1e-9 + 2.0 * rounded_s);
    if (dt <= 2.0 * rounded_s) continue;
    const double speed = distance(poses[i].position, poses[i - 1].position) / dt;
    EXPECT_LE(speed, 0.8 + 1e-9);
    EXPECT_LE(speed - before, 0.8 * 0.1 + 1e-6);
    EXPECT_LE(testing::own_angle(poses[i].heading_rad - poses[i - 1].heading_rad) / dt, 0.8 + 1e-9);
    before = speed;
  }
}

TEST(SimulatedGuard, BringsTheBarrelWhereItIsTold) {
  const GuardProblem problem = one_target();
  const FiringMap firing_map = firing_map_of(problem, {.resolution_m = 0.25});
  Log log;
  auto robot = simulated_guard(problem, firing_map, log, 1);
  robot.act(FollowWaypoints{{{0, 0}, {1, 1}}});
  const double begin = robot.sense().time_s;
  const double heading = robot.sense().odometry.heading_rad;
  robot.act(AimGun{-2.5, 0.4});
  const Observation seen = robot.sense();
  EXPECT_NEAR(testing::own_angle(seen.odometry.heading_rad + seen.gun->yaw_rad + 2.5), 0.0, 1e-12);
  EXPECT_NEAR(seen.gun->pitch_rad, 0.4, 1e-12);
  EXPECT_NEAR(seen.time_s - begin, std::max(testing::own_angle(-2.5 - heading) / pi, 0.4 / (pi / 6)), 1e-9);
  robot.act(AimGun{-2.5, 0.4});
  EXPECT_EQ(robot.sense().time_s, seen.time_s);
}

TEST(SimulatedGuard, GoesOnWhileABallIsInTheAirAndTellsWhenItHasLanded) {
  const GuardProblem problem = one_target();
  const FiringMap firing_map = firing_map_of(problem, {.resolution_m = 0.25});
  Log log;
  auto robot = simulated_guard(problem, firing_map, log, 7);
  robot.act(AimGun{0.0, 0.2});
  const double begin = robot.sense().time_s;
  robot.act(Fire{0, {0.0, 0.2, 6.5}, false});
  const Observation fired = robot.sense();
  EXPECT_EQ(fired.time_s, begin);
  EXPECT_TRUE(fired.shots.empty());
  const auto shot = *log.latest<outrider_msgs::Shot>(topic::shots);
  ASSERT_GT(shot.flight, 0.1);
  robot.act(Wait{begin + shot.flight - 0.01});
  EXPECT_TRUE(robot.sense().shots.empty()) << "it is still in the air";
  robot.act(Wait{begin + shot.flight});
  const Observation landed = robot.sense();
  ASSERT_EQ(landed.shots.size(), 1U);
  EXPECT_EQ(landed.shots[0].hit, shot.hit);
  EXPECT_EQ(landed.shots[0].landed_s, begin + shot.flight);
  EXPECT_TRUE(robot.sense().shots.empty()) << "told once";
}

TEST(SimulatedGuard, TurnsItsGunDuringADrive) {
  GuardProblem problem = one_target();
  problem.errors.position_m = problem.errors.heading_rad = 0.0;
  problem.gun.pitch_rate_radps = 0.15;
  const FiringMap firing_map = firing_map_of(problem, {.resolution_m = 0.25});
  for (const double pitch : {0.2, 0.7}) {
    Log log;
    auto robot = simulated_guard(problem, firing_map, log, 7);
    const Observation before = robot.sense();
    FollowWaypoints drive{{before.odometry.position, before.odometry.position + Vec2{1.0, 0.5}}};
    drive.aim = AimGun{1.3, pitch};
    robot.act(drive);
    const Observation after = robot.sense();
    const double turned = 0.15 * (after.time_s - before.time_s);
    ASSERT_TRUE(turned > 0.2 && turned < 0.7) << "one aim is reached, the other is not";
    EXPECT_NEAR(after.gun->pitch_rad, std::min(pitch, turned), 1e-9);
    EXPECT_NEAR(testing::own_angle(after.odometry.heading_rad + after.gun->yaw_rad - 1.3), 0.0, 1e-9);
  }
}

TEST(SimulatedGuard, ShotsStrayUniformlyWithinTheErrorsAndReplayExactly) {
  const GuardProblem problem = one_target();
  const FiringMap firing_map = firing_map_of(problem, {.resolution_m = 0.25});
  Log log;
  auto robot = simulated_guard(problem, firing_map, log, 9);
  const Shot shot{0.0, 0.2, 6.5};
  robot.act(AimGun{0.0, 0.2});
  const int shots = 2000;
  std::array<std::array<int, 4>, 3> counts{};
  for (int i = 0; i < shots; ++i) {
    const double before = robot.sense().time_s;
    robot.act(Fire{0, shot});
    const Observation seen = robot.sense();
    ASSERT_EQ(seen.shots.size(), 1U);
    EXPECT_TRUE(robot.sense().shots.empty()) << "told once";
    const auto& [time_ns, fired] = log.messages<outrider_msgs::Shot>(topic::shots).back();
    EXPECT_EQ(seen.shots[0].hit, fired.hit);
    EXPECT_EQ(fired.attempt, static_cast<std::uint32_t>(i + 1));
    EXPECT_EQ(time_ns, nanoseconds(before));
    EXPECT_DOUBLE_EQ(seen.time_s, before + fired.flight);
    const Vec3 v = vec3_of(fired.velocity);
    const std::array<double, 3> error{std::atan2(v.y, v.x) / 0.01,
                                      (std::atan2(v.z, std::hypot(v.x, v.y)) - 0.2) / 0.01,
                                      (norm(v) / 6.5 - 1.0) / 0.01};
    for (std::size_t k = 0; k < 3; ++k) {
      ASSERT_LE(std::abs(error[k]), 1.0 + 1e-9);
      ++counts[k][static_cast<std::size_t>(std::clamp(2.0 * error[k] + 2.0, 0.0, 3.0))];
    }
    if (i % (shots / testing::costly_cases(25)) != 0) continue;
    const Solid target = solid_of(problem.targets[0]);
    const auto fine = testing::fly_fine(vec3_of(fired.muzzle), v, 9.8, 0.01, firing_map.space(0).solids(),
                                        &target, -1.0, 5e-6);
    EXPECT_EQ(fine.hit, fired.hit);
    EXPECT_LT(norm(fine.position - vec3_of(fired.contact_point)), 1.1e-5);
    EXPECT_EQ(fired.contact, fine.hit ? "cat" : firing_map.space(0).solids()[*fine.solid].name);
  }
  for (const auto& axis : counts) {
    for (const int count : axis) EXPECT_NEAR(count, 500, 90);
  }
}

TEST(SimulatedGuard, TheReferenceRuleIsTheBallNearTheBase) {
  Rng rng(102);
  GuardProblem problem = one_target();
  int counted = 0;
  int uncounted = 0;
  for (int i = 0; i < cases(100); ++i) {
    problem.targets[0].base = {rng.uniform(1.0, 4.0), 0.0, rng.uniform(0.0, 1.5)};
    const FiringMap firing_map = firing_map_of(problem, {.resolution_m = 0.25});
    Log log;
    auto robot = simulated_guard(problem, firing_map, log, static_cast<std::uint64_t>(i));
    robot.act(Fire{0, {rng.uniform(-0.4, 0.4), rng.uniform(-0.2, 0.7), rng.uniform(3.0, 9.0)}});
    const auto& fired = *log.latest<outrider_msgs::Shot>(topic::shots);
    double nearest = 1e9;
    for (int k = 0; k <= 20000; ++k) {
      const double t = fired.flight * k / 20000.0;
      const Vec3 p = vec3_of(fired.muzzle) + t * vec3_of(fired.velocity) - Vec3{0, 0, 4.9 * t * t};
      nearest = std::min(nearest, norm(p - problem.targets[0].base));
    }
    if (std::abs(nearest - 0.5) < 1e-3) continue;
    EXPECT_EQ(fired.hit_by_reference_rule, nearest < 0.5);
    (nearest < 0.5 ? counted : uncounted) += 1;
  }
  EXPECT_GT(counted, 8);
  EXPECT_GT(uncounted, 15);
}

TEST(SimulatedGuard, SameSeedSameRunOtherSeedOtherRun) {
  const GuardProblem problem = one_target();
  const FiringMap firing_map = firing_map_of(problem, {.resolution_m = 0.25});
  const auto end = [&](std::uint64_t seed) {
    Log log;
    auto robot = simulated_guard(problem, firing_map, log, seed);
    robot.act(FollowWaypoints{{{0, 0}, {1, 0}}});
    robot.act(Fire{0, {0.0, 0.1, 6.0}});
    return vec3_of(log.latest<outrider_msgs::Shot>(topic::shots)->contact_point);
  };
  EXPECT_EQ(end(3), end(3));
  EXPECT_FALSE(end(3) == end(4));
}

}  // namespace
}  // namespace outrider
