#include <gtest/gtest.h>

#include "outrider/jobs/guard/mission/mission.hpp"
#include "outrider/jobs/guard/mission/task_board.hpp"
#include "outrider/jobs/guard/plan/plan.hpp"
#include "outrider/jobs/guard/run/robot.hpp"
#include "outrider/jobs/guard/run/run.hpp"
#include "outrider/log/messages/conversions.hpp"
#include "outrider/log/messages/gun_messages.hpp"
#include "outrider/log/topics.hpp"
#include "support/guard_runs.hpp"
#include "support/guard_yard.hpp"
#include "support/random_cases.hpp"
#include "support/run_bytes.hpp"

namespace outrider {
namespace {

using testing::cases;
using testing::floor_at;
using testing::fly_fine;
using testing::planned_yard;
using testing::PlannedYard;
using testing::street;

GuardOptions on_the_move() {
  GuardOptions options;
  options.resolution_m = 0.2;
  options.stops = 60;
  options.iterations = 200;
  options.shoot_on_the_move = true;
  return options;
}

PlannedYard planned_in_passing(GuardProblem problem) {
  GuardOptions from_rest = on_the_move();
  from_rest.shoot_on_the_move = false;
  PlannedYard yard = planned_yard(std::move(problem), from_rest);
  GuardPlan passing = shoot_in_passing(yard.problem, yard.firing_map, yard.plan);
  EXPECT_LT(passing.cost_s, yard.plan.cost_s);
  yard.plan = std::move(passing);
  return yard;
}

TEST(PassingRun, WithoutErrorsTakesWhatThePlanSays) {
  GuardProblem problem = street();
  problem.errors = {0.0, 0.0, {0.0, 0.0}, 0.0};
  const PlannedYard p = planned_in_passing(problem);
  const auto run = testing::run_still(p.problem, p.firing_map, p.plan, on_the_move(), 1);
  EXPECT_NEAR(metric(run, "mission_s"), p.plan.cost_s, 1e-6);
  EXPECT_EQ(metric(run, "reached"), 5.0);
  EXPECT_EQ(metric(run, "shots"), 5.0);
  EXPECT_GT(metric(run, "hits_in_passing"), 0.0);
}

/// The robot's place and velocity by the track, at a time between two samples.
Platform seen_at(const std::vector<testing::TrackSample>& track, double time_s) {
  for (std::size_t i = 1; i < track.size(); ++i) {
    const testing::TrackSample& a = track[i - 1];
    const testing::TrackSample& b = track[i];
    if (b.time_s < time_s || b.time_s == a.time_s) continue;
    const double part = (time_s - a.time_s) / (b.time_s - a.time_s);
    return {a.pose.position + part * (b.pose.position - a.pose.position),
            1.0 / (b.time_s - a.time_s) * (b.pose.position - a.pose.position)};
  }
  return {};
}

TEST(PassingRun, ShotsLeaveTheRobotThatDrives) {
  const PlannedYard p = planned_in_passing(street());
  double passed = 0.0;
  for (int seed = 1; seed <= cases(4); ++seed) {
    auto run =
        testing::run_still(p.problem, p.firing_map, p.plan, on_the_move(), static_cast<std::uint64_t>(seed));
    const auto track = testing::track_of(run.log);
    const double gun_length_m = run.log.latest<outrider_msgs::RunInfo>(topic::run)->gun_length;
    EXPECT_EQ(metric(run, "reached"), 5.0);
    for (const auto& stamped : testing::shots_of(run.log)) {
      const outrider_msgs::Shot& shot = stamped.message;
      const Vec3 muzzle = testing::vec3_of(shot.muzzle), velocity_mps = testing::vec3_of(shot.velocity);
      const Platform seen = seen_at(track, stamped.time_s());
      const Vec2 tip = xy(muzzle) - seen.position;
      EXPECT_LT(norm(tip), gun_length_m + 1e-9);
      const Vec2 platform = vec2_of(shot.platform_velocity);
      EXPECT_LT(distance(platform, seen.velocity_mps), 0.05);  // the samples are up to 0.1 s apart
      // Without the robot's velocity the ball leaves along the barrel, which is above the yaw axis.
      const Vec2 along = xy(velocity_mps) - platform;
      EXPECT_NEAR(cross(tip, along), 0.0, 1e-9 * norm(along));
      const auto& target = *std::ranges::find(p.problem.targets, shot.target, &Target::name);
      const Solid solid = solid_of(target);
      const auto end = fly_fine(muzzle, velocity_mps, 9.8, p.problem.gun.ball_radius_m,
                                p.problem.world.solids, &solid, -1.0);
      EXPECT_EQ(end.hit, shot.hit);
      EXPECT_NEAR(end.time_s, shot.flight, 1e-4);
      passed += platform != Vec2{} ? 1.0 : 0.0;
    }
    EXPECT_TRUE(testing::stamps_are_sorted(run.log));
    test::LogRecorder recorder;
    EXPECT_EQ(test::bytes_of_run(run), test::bytes_of_run(testing::run_still(
                                           p.problem, p.firing_map, p.plan, on_the_move(),
                                           static_cast<std::uint64_t>(seed), {.sinks = {&recorder}})));
    EXPECT_EQ(recorder.finish(), test::bytes_of_log(run.log));
  }
  EXPECT_GT(passed, 3.0);
}

/// Intruders in their places: who can be hit from a drive needs no stop, and all are hit sooner than from
/// rest.
TEST(PassingRun, IntrudersAreHitByTheWay) {
  const PlannedYard p = planned_in_passing(street());
  GuardOptions from_rest = on_the_move();
  from_rest.shoot_on_the_move = false;
  auto plan = plan_guard(p.problem, p.firing_map, from_rest, {});
  ASSERT_TRUE(plan.has_value());
  const auto watch = arrival_yard(p.problem, p.firing_map, settled_intruders(p.problem));
  double last_s = 0.0;
  for (const bool moving : {false, true}) {
    plan->on_the_move = moving;
    const auto stops = precompute_stops(p.problem, p.firing_map, *plan, usual_stops, {});
    ASSERT_TRUE(stops.has_value());
    const RollingPlan arrivals{watch, *stops, *find_replan_policy("each_arrival"),
                               ArrivalObjective::makespan};
    const auto run = testing::run_arrivals(arrivals, from_rest, 1);
    EXPECT_EQ(run.report.status, "done") << run.report.reason;
    EXPECT_GE(metric(run, "makespan_s"), metric(run, "makespan_bound_s"));
    if (moving) {
      EXPECT_GE(metric(run, "hits_in_passing"), 1.0);
      EXPECT_LT(metric(run, "makespan_s"), 0.95 * last_s);
    }
    last_s = metric(run, "makespan_s");
  }
}

TEST(PassingRun, WhoIsMissedInPassingIsShotAtFromRest) {
  const PlannedYard p = planned_in_passing(street());
  GuardProblem shaky = p.problem;  // worse than planned for
  shaky.errors.aim = {0.12, 0.05};
  int missed = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Log log;
    auto robot = simulated_guard(shaky, p.firing_map, log, seed);
    GuardMission mission(p.problem, p.firing_map, p.plan);
    while (const auto command = mission.step(robot.sense())) robot.act(*command);
    for (std::size_t t = 0; t < mission.board().records().size(); ++t) {
      const TargetRecord& record = mission.board().records()[t];
      EXPECT_NE(record.status, TargetStatus::waiting);
      std::vector<const outrider_msgs::Shot*> shots;
      for (const auto& shot : log.messages<outrider_msgs::Shot>(topic::shots)) {
        if (shot.message.target == p.problem.targets[t].name) shots.push_back(&shot.message);
      }
      EXPECT_EQ(shots.size(), static_cast<std::size_t>(record.shots));
      ASSERT_FALSE(shots.empty());
      EXPECT_EQ(shots.back()->hit, record.status == TargetStatus::reached);
      const auto drives = [](const outrider_msgs::Shot& shot) {
        return vec2_of(shot.platform_velocity) != Vec2{};
      };
      for (std::size_t k = 1; k < shots.size(); ++k) EXPECT_FALSE(drives(*shots[k]));
      missed += drives(*shots.front()) && !shots.front()->hit ? 1 : 0;
    }
  }
  EXPECT_GT(missed, 0);
}

/// A target is to be hit on a drive from which it cannot be hit: it gets a stop where the way leads past it,
/// and a later drive hits it before.
TEST(PassingRun, WhoIsLostOnOneDriveIsHitFromALaterOne) {
  const PlannedYard p = planned_in_passing(street());
  constexpr std::size_t lost = 4;  // at x = 13.6 m
  TaskBoard board(p.problem, p.firing_map, p.plan);
  board.set_tasks({{{1.0, 0.0}, {0}, {}, {lost}}, {{3.0, 0.0}, {1}}, {{15.0, 0.0}, {3}}});
  Observation seen{0.0, p.problem.start};
  seen.gun = GunState{};
  const auto first = board.next_command(seen);
  ASSERT_TRUE(first && std::holds_alternative<FollowWaypoints>(*first));
  EXPECT_TRUE(std::get<FollowWaypoints>(*first).shots.empty());
  const auto hits_it = [=](const StopTask& task) { return std::ranges::count(task.targets, lost) > 0; };
  const auto stop = std::ranges::find_if(board.queue(), hits_it);
  ASSERT_NE(stop, board.queue().end());
  EXPECT_GT(stop->place.x, 3.0);
  EXPECT_GE(stop - board.queue().begin(), 2) << "no detour before the second stop";

  board.set_tasks({board.queue().begin() + 2, board.queue().end()});
  seen.odometry = {{3.0, 0.0}, 0.0};
  const auto later = board.next_command(seen);
  ASSERT_TRUE(later && std::holds_alternative<FollowWaypoints>(*later));
  const auto& shots = std::get<FollowWaypoints>(*later).shots;
  ASSERT_EQ(shots.size(), 1U);
  EXPECT_EQ(shots.front().target, lost);
  EXPECT_TRUE(std::ranges::none_of(board.queue(), hits_it));
}

/// A robot that carries nothing out and tells nothing.
TEST(PassingRun, EndsWhenNobodyTellsOfTheShots) {
  const PlannedYard p = planned_in_passing(street());
  GuardMission mission(p.problem, p.firing_map, p.plan);
  Observation seen{.odometry = p.problem.start, .gun = GunState{}};
  int commands = 0;
  while (const auto command = mission.step(seen)) {
    ASSERT_LT(++commands, 500);
    seen.time_s += 1.0;
    if (const auto* follow = std::get_if<FollowWaypoints>(&*command)) {
      seen.odometry.position = follow->waypoints.back();
    }
  }
  for (const TargetRecord& record : mission.board().records()) EXPECT_EQ(record.status, TargetStatus::failed);
}

/// A robot that does at once what it is told; its balls take a second to land, and the first at each target
/// misses.
struct SlowBalls final : Robot {
  explicit SlowBalls(const GuardProblem& problem)
      : seen{.odometry = problem.start, .gun = GunState{}}, shots(problem.targets.size(), 0) {}

  Observation sense() override {
    Observation now = seen;
    for (const ShotResult& ball : balls) {
      if (ball.landed_s <= now.time_s) now.shots.push_back(ball);
    }
    std::erase_if(balls, [&](const ShotResult& ball) { return ball.landed_s <= now.time_s; });
    return now;
  }
  void shoot(std::size_t target) { balls.push_back({target, ++shots[target] > 1, seen.time_s + 1.0}); }
  void act(const Command& command) override {
    if (const auto* follow = std::get_if<FollowWaypoints>(&command)) {
      seen.time_s += 0.1;
      seen.odometry.position = follow->waypoints.back();
      for (const FireInPassing& shot : follow->shots) shoot(shot.target);
    } else if (const auto* fire = std::get_if<Fire>(&command)) {
      shoot(fire->target);
      if (fire->until_landed) seen.time_s += 1.0;
      left_flying += fire->until_landed ? 0 : 1;
    } else if (const auto* wait = std::get_if<Wait>(&command)) {
      EXPECT_FALSE(balls.empty()) << "waits for nothing";
      seen.time_s = wait->until_s;
    }
  }

  Observation seen;
  std::vector<int> shots;
  std::vector<ShotResult> balls;
  int left_flying = 0;
};

TEST(PassingRun, AMissThatIsToldLateIsShotAtAgain) {
  const PlannedYard p = planned_in_passing(street());
  SlowBalls robot(p.problem);
  GuardMission mission(p.problem, p.firing_map, p.plan);
  int commands = 0;
  while (const auto command = mission.step(robot.sense())) {
    ASSERT_LT(++commands, 500);
    robot.act(*command);
  }
  EXPECT_TRUE(robot.balls.empty()) << "it ends when the last ball has landed";
  EXPECT_GT(robot.left_flying, 0);
  for (const TargetRecord& record : mission.board().records()) {
    EXPECT_EQ(record.status, TargetStatus::reached) << record.reason;
    EXPECT_EQ(record.shots, 2);
  }
}

}  // namespace
}  // namespace outrider
