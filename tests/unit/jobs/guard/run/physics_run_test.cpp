#include "outrider/jobs/guard/run/run.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "outrider/core/rng.hpp"
#include "support/fine_flight.hpp"
#include "support/guard_runs.hpp"
#include "support/logged_targets.hpp"
#include "support/planned_yard.hpp"
#include "support/random_cases.hpp"
#include "support/run_bytes.hpp"

namespace outrider {
namespace {

using testing::box_at;
using testing::cases;
using testing::quick;

class RunGuardInPhysics : public ::testing::Test {
 protected:
  void SetUp() override {
    Rng rng(620);
    const auto ok = make_rigid_world(rigid_scene(testing::random_guard_problem(rng, 0, 1, 2.5)));
    if (!ok) GTEST_SKIP() << ok.error().sentence;
  }

  static outrider::Run carry_out(const GuardProblem& problem, std::uint64_t seed, LogSink* sink = nullptr,
                                 const GuardOptions& options = quick()) {
    const testing::PlannedYard yard = testing::planned_yard(problem, options);
    double last = 0.0;
    RunWatch watch;
    if (sink != nullptr) watch.sinks = {sink};
    watch.progress = [&](const RunStep& step) {
      EXPECT_GE(step.part, last);
      last = step.part;
    };
    GuardScenario scenario = testing::settings(options, seed);
    scenario.sim = "physics";
    auto run = testing::carried_out(scenario, {problem, yard.firing_map, yard.plan}, watch);
    EXPECT_EQ(last, 1.0);
    return run;
  }
};

TEST_F(RunGuardInPhysics, HitsWhatThePlanPromises) {
  Rng rng(621);
  for (int i = 0; i < cases(2); ++i) {
    auto problem = testing::random_guard_problem(rng, 8, 4, 2.5);
    const bool exact = i % 2 == 0;
    if (exact) problem.errors = {0.0, 0.0, {0.0, 0.0}};
    const auto run = carry_out(problem, static_cast<std::uint64_t>(i));
    EXPECT_EQ(run.log.latest<outrider_msgs::RunInfo>(topic::run)->sim, "physics");
    EXPECT_EQ(metric(run, "failed"), 0.0);
    // The wheels take a little longer than the profiles, and come as near as this.
    if (exact) {
      EXPECT_GT(metric(run, "mission_s"), metric(run, "planned_s") - 0.05);
      EXPECT_LT(metric(run, "mission_s"), 1.1 * metric(run, "planned_s") + 1.0);
    }
    EXPECT_LT(metric(run, "arrival_error_max_m"), 0.01);
    EXPECT_LE(metric(run, "arrival_error_mean_m"), metric(run, "arrival_error_max_m"));
    EXPECT_EQ(metric(run, "bumps"), 0.0);
    // Semi-implicit Euler: g h t / 2 below the parabola, with h = 0.25 ms and flights under 2 s.
    EXPECT_LT(metric(run, "flight_error_max_m"), 0.5 * 9.8 * 0.25e-3 * 2.0);
    EXPECT_GE(metric(run, "shots_as_foreseen"), metric(run, "shots") - 1.0);
    EXPECT_TRUE(testing::stamps_are_sorted(run.log));
  }
}

/// The pose of the robot by the log at a time, between two samples.
Pose2 logged_at(const std::vector<testing::TrackSample>& track, double time_s) {
  const auto next = std::ranges::lower_bound(track, time_s, {}, &testing::TrackSample::time_s);
  if (next == track.begin() || next == track.end()) return track.front().pose;
  const auto last = std::prev(next);
  const double part = (time_s - last->time_s) / (next->time_s - last->time_s);
  return {last->pose.position + part * (next->pose.position - last->pose.position), next->pose.heading_rad};
}

TEST_F(RunGuardInPhysics, ShootsInPassingAsTheExactFlightsForetell) {
  const GuardProblem problem = testing::street();
  double passed = 0.0, beside_another = 0.0;
  for (int seed = 1; seed <= cases(2); ++seed) {
    test::LogRecorder recorder;
    auto run = carry_out(problem, static_cast<std::uint64_t>(seed), &recorder, testing::quick_on_the_move());
    EXPECT_EQ(recorder.finish(), test::bytes_of_log(run.log));
    EXPECT_TRUE(testing::stamps_are_sorted(run.log));
    EXPECT_EQ(metric(run, "reached"), 5.0);
    EXPECT_EQ(metric(run, "bumps"), 0.0);
    EXPECT_LT(metric(run, "mission_s"), metric(run, "planned_s") + 1.0);
    passed += metric(run, "shots_in_passing");
    const auto track = testing::track_of(run.log);
    double last_landed_s = 0.0;
    const auto& shots = testing::shots_of(run.log);
    EXPECT_EQ(static_cast<double>(shots.size()), metric(run, "shots"));
    for (const auto& stamped : shots) {
      const outrider_msgs::Shot& shot = stamped.message;
      const Vec2 robot = vec2_of(shot.robot), platform = vec2_of(shot.platform_velocity);
      EXPECT_LT(distance(robot, logged_at(track, stamped.time_s()).position), 1e-3);
      if (platform != Vec2{}) {
        const Vec2 later = logged_at(track, stamped.time_s() + 0.02).position;
        EXPECT_LT(distance(platform, 50.0 * (later - robot)), 0.05);
      }
      // The ball leaves the barrel with the speed of the robot on top, and flies as small steps do.
      const Vec3 muzzle = testing::vec3_of(shot.muzzle), velocity = testing::vec3_of(shot.velocity);
      EXPECT_NEAR(cross(xy(muzzle) - robot, xy(velocity) - platform), 0.0, 1e-4);
      const Solid box = solid_of(*std::ranges::find(problem.targets, shot.target, &Target::name));
      const auto end = testing::fly_fine(muzzle, velocity, 9.8, problem.gun.ball_radius_m,
                                         problem.world.solids, &box, -1.0);
      EXPECT_EQ(end.hit, shot.hit);
      EXPECT_NEAR(end.time_s, shot.flight, 2e-3);
      beside_another += stamped.time_s() < last_landed_s ? 1.0 : 0.0;
      last_landed_s = std::max(last_landed_s, stamped.time_s() + shot.flight);
    }
  }
  EXPECT_GT(passed, 2.0);
  EXPECT_GT(beside_another, 0.0) << "balls are in the air at the same time";
}

/// Two targets near each other, and a robot that does not wait for its balls.
TEST_F(RunGuardInPhysics, TimeGoesOnForTheRobotWhileBallsFly) {
  GuardProblem problem = testing::street();
  problem.errors.aim = {0.0, 0.0};
  const auto firing_map = build_firing_map(problem, quick());
  ASSERT_TRUE(firing_map.has_value());
  Log log;
  auto made = rigid_guard(problem, *firing_map, log, 1);
  ASSERT_TRUE(made.has_value());
  SimulatedRobot& robot = *made;
  const Shot high{0.5, 1.3, 9.0}, low{0.5, 0.9, 2.0};
  robot.act(AimGun{high.yaw_rad, high.pitch_rad});
  robot.act(Fire{0, high, false});
  const double fired_s = robot.sense().time_s;
  robot.act(AimGun{low.yaw_rad, low.pitch_rad});
  robot.act(Fire{1, low, false});
  const Observation flying = robot.sense();
  EXPECT_GT(flying.time_s, fired_s + 0.1);
  EXPECT_TRUE(flying.shots.empty());
  robot.act(FollowWaypoints{{robot.sense().odometry.position, {1.0, 0.0}}});
  const auto landed = robot.sense().shots;
  ASSERT_EQ(landed.size(), 2U);
  EXPECT_EQ(landed[0].target, 1U) << "the lower shot lands sooner";
  EXPECT_LT(landed[0].landed_s, landed[1].landed_s);
  const auto& shots = testing::shots_of(log);
  ASSERT_EQ(shots.size(), 2U);
  EXPECT_EQ(shots[0].message.target, problem.targets[0].name) << "the log has them as they were fired";
  EXPECT_NEAR(shots[0].time_s(), fired_s, 1e-9);
  EXPECT_NEAR(shots[0].time_s() + shots[0].message.flight, landed[1].landed_s, 1e-3);

  const double rests_s = robot.sense().time_s;
  robot.act(Wait{rests_s + 0.7});
  EXPECT_NEAR(robot.sense().time_s, rests_s + 0.7, 2e-3);
}

TEST_F(RunGuardInPhysics, GivesTheSameBytesTwice) {
  Rng rng(622);
  const auto problem = testing::random_guard_problem(rng, 8, 4, 2.5);
  const std::string first = test::bytes_of_run(carry_out(problem, 5));
  test::LogRecorder recorder;
  auto again = carry_out(problem, 5, &recorder);
  EXPECT_EQ(first, test::bytes_of_run(again));
  EXPECT_EQ(recorder.finish(), test::bytes_of_log(again.log));
  EXPECT_NE(first, test::bytes_of_run(carry_out(problem, 6)));
}

TEST_F(RunGuardInPhysics, SaysWhatAMissTouchedAndWhere) {
  Rng rng(623);
  auto problem = testing::random_guard_problem(rng, 4, 5, 3.5);
  problem.errors.aim = {0.5, 0.5};
  problem.tries = 2;
  int missed = 0;
  for (std::uint64_t seed = 1; missed == 0 && seed <= 4; ++seed) {
    const auto run = carry_out(problem, seed);
    const auto misses = events_of(run.log, "miss");
    for (const auto& [time_ns, shot] : testing::shots_of(run.log)) {
      if (shot.hit) continue;
      ++missed;
      EXPECT_NE(shot.contact, shot.target);
      EXPECT_TRUE(std::ranges::any_of(misses, [&said = shot](const auto& event) {
        const std::string& text = event.message.msg;
        return text.starts_with("misses " + said.target) &&
               text.find("touches " + said.contact + " at (") != std::string::npos &&
               text.find("m from it") != std::string::npos;
      })) << shot.contact;
    }
    for (const auto& target : testing::targets_of(run.log)) {
      if (target.status != "failed") continue;
      EXPECT_NE(target.reason.find("; the last shot touches "), std::string::npos) << target.reason;
    }
  }
  EXPECT_GT(missed, 0);
}

}  // namespace
}  // namespace outrider
