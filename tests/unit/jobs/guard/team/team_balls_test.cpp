#include "team/team_balls.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "outrider/jobs/guard/team/team_plan.hpp"
#include "outrider/jobs/guard/team/team_run.hpp"
#include "outrider/log/messages/gun_messages.hpp"
#include "outrider/log/topics.hpp"
#include "support/guard_yard.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

using testing::cases;

/// The nearest that the ball comes to the body in fine steps, above the floor.
double nearest_in_steps(const GuardProblem& problem, const TeamBall& ball, const TimedDrives& driven) {
  double nearest = 1e9;
  for (double t = 0.0; t <= ball.lands_s - ball.fired_s; t += 2e-4) {
    const Vec3 at = ball.flight.position(t);
    const Vec2 body = place_at(problem.robot, driven, ball.fired_s + t);
    const double beside = std::max(0.0, distance(xy(at), body) - problem.robot.radius_m);
    const double above = std::max({0.0, at.z - problem.robot.height_m, -at.z});
    nearest = std::min(nearest, std::hypot(beside, above) - problem.gun.ball_radius_m);
  }
  return nearest;
}

TEST(TeamBalls, TouchBodiesAsFineStepsDo) {
  Rng rng(31);
  GuardProblem problem;
  problem.robot.height_m = 0.5;
  int touched = 0;
  for (int i = 0; i < cases(300); ++i) {
    const auto place = [&] { return Vec2{rng.uniform(-2.0, 2.0), rng.uniform(-2.0, 2.0)}; };
    TimedDrives driven{{place(), rng.uniform(-pi, pi)}, {}};
    driven.drives.push_back({rng.uniform(0.0, 1.0), {driven.start.position, place(), place()}});
    const double yaw = heading_of(driven.start.position) + rng.uniform(-0.6, 0.6);
    const double speed = rng.uniform(2.0, 8.0);
    const Flight flight{{0.0, 0.0, 0.4},
                        {speed * std::cos(yaw), speed * std::sin(yaw), rng.uniform(-2.0, 3.0)}};
    TeamBall ball{flight, rng.uniform(0.0, 4.0), 0.0};
    ball.lands_s = ball.fired_s + rng.uniform(0.3, 1.0);
    const auto touch = touches_body(problem, ball, driven);
    const double nearest = nearest_in_steps(problem, ball, driven);
    EXPECT_EQ(touch.has_value(), nearest <= 1e-6 || (touch && nearest < 2e-3)) << nearest;
    touched += touch ? 1 : 0;

    // Presences are where the robot may be, so they are never farther away.
    std::vector<Presence> present{
        {0.0, driven.drives[0].begin_s, {driven.start.position, driven.start.position}}};
    const auto drive = presences(problem.robot, driven.start.heading_rad, driven.drives[0].waypoints,
                                 driven.drives[0].begin_s, 0.0);
    present.insert(present.end(), drive.begin(), drive.end());
    if (nearest < 0.04) {
      EXPECT_TRUE(may_touch(problem, ball, present)) << nearest;
    }
    if (may_touch(problem, ball, present)) {
      EXPECT_LT(nearest, 0.4);  // pieces of 0.25 s are 0.2 m long
    }
  }
  EXPECT_GT(touched, cases(300) / 15);
}

/// A yard in which the second robot stands between the first one and its target, where the ball is low.
struct LineOfFire {
  GuardProblem problem;
  std::vector<Pose2> starts;
};

LineOfFire line_of_fire(double second_y) {
  LineOfFire made;
  GuardProblem& problem = made.problem;
  problem.world.bounds = {{-4, -4}, {4, 4}};
  problem.world.solids = {testing::floor_at(0)};
  problem.start = {{-3.0, 0.0}, 0.0};
  problem.robot.height_m = 1.5;  // no ball flies over it
  problem.errors = {0.0, 0.0, {0.0, 0.0}, 0.0};
  problem.targets = {{"cat", {2.0, 0.0, 0.0}, {0.3, 0.3, 0.3}}};
  made.starts = {problem.start, {{0.0, second_y}, 0.0}};
  return made;
}

/// A plan in which the first robot shoots at once from its start, and the second one does nothing.
TeamPlan shot_from_start(const GuardProblem& problem, const FiringMap& firing_map,
                         const std::vector<Pose2>& starts) {
  TeamPlan plan;
  plan.parts.resize(2);
  for (std::size_t r = 0; r < 2; ++r) plan.parts[r].start = starts[r];
  const auto shot =
      best_shot(firing_map.rules, firing_map.space(0), problem.targets[0], problem.start.position, 0.0);
  PlannedStop stop{problem.start.position, {problem.start.position}, {}};
  stop.hits.push_back({0, shot.value()});
  plan.parts[0].plan.stops.push_back(stop);
  plan.parts[0].times.begins_s = {0.0};
  plan.parts[0].times.turns = {0};
  return plan;
}

TEST(RunTeam, DoesNotShootAtARobotThatStandsInTheLineOfFire) {
  const auto [problem, starts] = line_of_fire(0.0);
  const auto firing_map = build_firing_map(problem, testing::quick());
  ASSERT_TRUE(firing_map.has_value());
  const TeamRun run = run_team(problem, *firing_map, shot_from_start(problem, *firing_map, starts), 1);
  EXPECT_EQ(run.stopped, 0U);
  EXPECT_GE(run.given_up, 1U);
  // In the second pass the robot shoots from elsewhere, or says why it does not.
  for (const auto& [time_ns, shot] : run.robots[0].log.messages<outrider_msgs::Shot>(topic::shots))
    EXPECT_TRUE(shot.hit);
  const TargetRecord& record = run.records[0];
  EXPECT_TRUE(record.status == TargetStatus::reached ||
              record.reason.find("robot 2 stood in the") != std::string::npos)
      << record.reason;

  const auto [clear, apart] = line_of_fire(2.0);
  const TeamRun reached = run_team(clear, *firing_map, shot_from_start(clear, *firing_map, apart), 1);
  EXPECT_EQ(reached.given_up, 0U);
  EXPECT_EQ(reached.records[0].status, TargetStatus::reached);
  EXPECT_EQ(reached.records[0].shots, 1);
}

/// Errors of the gun that nobody knows of: the shot seems to pass, and the ball is stopped.
TEST(RunTeam, ABallThatTouchesARobotHasMissed) {
  auto [problem, starts] = line_of_fire(0.6);  // the planned flight passes 0.3 m beside the body
  GuardSimParams faults;
  faults.aim_ratio = 40.0;
  problem.errors.aim.gun_rad = radians(0.5);
  problem.tries = 30;
  problem.give_up_s = 0.0;
  const auto firing_map = build_firing_map(problem, testing::quick());
  ASSERT_TRUE(firing_map.has_value());
  std::size_t stopped = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const TeamRun run =
        run_team(problem, *firing_map, shot_from_start(problem, *firing_map, starts), seed, {}, faults);
    std::size_t seen = 0;
    for (const auto& [time_ns, shot] : run.robots[0].log.messages<outrider_msgs::Shot>(topic::shots)) {
      if (shot.contact != "robot 2") continue;
      ++seen;
      EXPECT_FALSE(shot.hit);
      const Vec2 at{shot.contact_point.x, shot.contact_point.y};
      EXPECT_LE(distance(at, starts[1].position), problem.robot.radius_m + problem.gun.ball_radius_m + 1e-3);
    }
    EXPECT_EQ(seen, run.stopped);
    stopped += run.stopped;
  }
  EXPECT_GT(stopped, 0U);
}

}  // namespace
}  // namespace outrider
