#include "outrider/jobs/guard/mission/mission.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "outrider/jobs/guard/plan/stops.hpp"
#include "support/planned_yard.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

using testing::box_at;
using testing::cases;
using testing::coarse;
using testing::floor_at;
using testing::planned_yard;
using testing::PlannedYard;
using testing::random_guard_problem;

/// A robot that does what it is told, as far as a script lets it.
struct Scripted final : Robot {
  explicit Scripted(const GuardProblem& problem) : seen{.odometry = problem.start, .gun = GunState{}} {}

  std::function<Vec2(Vec2 goal, int drive)> arrive = [](Vec2 goal, int) { return goal; };
  std::function<std::optional<bool>(std::size_t target, int shot)> hits = [](std::size_t, int) {
    return true;
  };

  Observation sense() override {
    Observation now = seen;
    seen.shots.clear();
    return now;
  }
  void act(const Command& command) override {
    seen.time_s += 1.0;
    if (const auto* follow = std::get_if<FollowWaypoints>(&command)) {
      EXPECT_LT(distance(follow->waypoints.front(), seen.odometry.position), 1e-9)
          << "a way starts where one stands";
      seen.odometry.position = arrive(follow->waypoints.back(), drives++);
      ways.push_back(follow->waypoints);
    } else if (const auto* aim = std::get_if<AimGun>(&command)) {
      aimed = *aim;
      seen.gun->yaw_rad = wrap_angle(aim->yaw_rad - seen.odometry.heading_rad);
      seen.gun->pitch_rad = aim->pitch_rad;
    } else if (!std::holds_alternative<Wait>(command)) {
      const auto& fire = std::get<Fire>(command);
      EXPECT_EQ(fire.shot.yaw_rad, aimed.yaw_rad) << "shot along another line than aimed";
      EXPECT_EQ(fire.shot.pitch_rad, aimed.pitch_rad);
      if (const auto hit = hits(fire.target, shots++)) seen.shots = {{fire.target, *hit, seen.time_s}};
      fired.push_back(fire.target);
    }
  }

  Observation seen;
  AimGun aimed;
  int drives = 0;
  int shots = 0;
  std::vector<std::size_t> fired;
  std::vector<std::vector<Vec2>> ways;
};

/// Two targets in the open and one that is out of reach.
GuardProblem three_targets() {
  GuardProblem problem;
  problem.world.bounds = {{-3, -3}, {3, 3}};
  problem.world.solids = {floor_at(0)};
  problem.start = {{0, -2.5}, radians(90)};
  problem.targets = {{"near", {0, 0, 0}, {0.5, 0.2, 0.4}, 0.0},
                     {"far", {2, 2, 0}, {0.5, 0.2, 0.4}, 0.0},
                     {"high", {0, 2, 9}, {0.5, 0.2, 0.4}, 0.0}};
  return problem;
}

/// Runs the mission; the number of commands is bounded.
GuardMission run(const PlannedYard& yard, Robot& robot, std::size_t most_commands = 2000) {
  GuardMission mission(yard.problem, yard.firing_map, yard.plan);
  std::size_t commands = 0;
  while (const auto command = mission.step(robot.sense())) {
    robot.act(*command);
    if (++commands > most_commands) {
      ADD_FAILURE() << "the mission does not end";
      break;
    }
  }
  return mission;
}

TEST(TaskBoard, ReachesWhatItHits) {
  const PlannedYard yard = planned_yard(three_targets(), coarse());
  Scripted robot(yard.problem);
  const GuardMission mission = run(yard, robot);
  EXPECT_EQ(mission.board().records()[0].status, TargetStatus::reached);
  EXPECT_EQ(mission.board().records()[1].status, TargetStatus::reached);
  EXPECT_EQ(mission.board().records()[2].status, TargetStatus::unreachable);
  EXPECT_EQ(robot.fired.size(), 2U);
  EXPECT_EQ(mission.board().records()[0].shots, 1);
  EXPECT_NE(mission.board().records()[0].reason.find("hit by shot 1 from"), std::string::npos);
  EXPECT_FALSE(mission.board().records()[2].reason.empty());
  Scripted idle(yard.problem);
  GuardMission over = mission;
  EXPECT_FALSE(over.step(idle.sense()).has_value()) << "over is over";
}

TEST(TaskBoard, TriesAsOftenAsAskedAndOnceMoreFromElsewhere) {
  PlannedYard yard = planned_yard(three_targets(), coarse());
  for (const std::int64_t tries : {1, 3, 5}) {
    yard.problem.tries = tries;
    Scripted robot(yard.problem);
    robot.hits = [](std::size_t target, int) { return target != 0; };
    const GuardMission mission = run(yard, robot);
    EXPECT_EQ(mission.board().records()[0].status, TargetStatus::failed);
    EXPECT_EQ(mission.board().records()[0].shots, 2 * tries);
    EXPECT_NE(mission.board().records()[0].reason.find(fmt::format("missed {} times", 2 * tries)),
              std::string::npos)
        << mission.board().records()[0].reason;
    EXPECT_EQ(mission.board().records()[1].status, TargetStatus::reached);
    // The second pass comes last and from another place.
    EXPECT_EQ(robot.fired.back(), 0U);
    ASSERT_GE(robot.ways.size(), 1U);
    EXPECT_GE(distance(robot.ways.back().back(), yard.plan.stops.back().position), 0.0);
    EXPECT_GE(distance(robot.ways.back().front(), robot.ways.back().back()), yard.problem.errors.position_m);
  }
}

TEST(TaskBoard, ASecondPassCanStillReach) {
  const PlannedYard yard = planned_yard(three_targets(), coarse());
  Scripted robot(yard.problem);
  std::vector<int> shots(3, 0);
  robot.hits = [&](std::size_t target, int) { return ++shots[target] > 3; };
  const GuardMission mission = run(yard, robot);
  EXPECT_EQ(mission.board().records()[0].status, TargetStatus::reached);
  EXPECT_EQ(mission.board().records()[1].status, TargetStatus::reached);
  EXPECT_EQ(mission.board().records()[0].shots, 4);
}

TEST(TaskBoard, AMissIsAimedAnewFromTheSamePlace) {
  const PlannedYard yard = planned_yard(three_targets(), coarse());
  Scripted robot(yard.problem);
  robot.hits = [](std::size_t, int shot) { return shot >= 2; };
  const GuardMission mission = run(yard, robot);
  EXPECT_EQ(robot.fired[0], robot.fired[1]);
  EXPECT_EQ(robot.fired[1], robot.fired[2]);
  EXPECT_EQ(mission.board().records()[robot.fired[0]].shots, 3);
}

TEST(TaskBoard, AShotOfWhichNothingIsHeardIsAMiss) {
  const PlannedYard yard = planned_yard(three_targets(), coarse());
  Scripted robot(yard.problem);
  robot.hits = [](std::size_t, int) { return std::optional<bool>{}; };
  const GuardMission mission = run(yard, robot);
  EXPECT_EQ(mission.board().records()[0].status, TargetStatus::failed);
  EXPECT_EQ(mission.board().records()[1].status, TargetStatus::failed);
  EXPECT_EQ(robot.fired.size(), 4U * static_cast<std::size_t>(yard.problem.tries));

  // A hit that nobody shot for is not counted either.
  GuardMission fresh(yard.problem, yard.firing_map, yard.plan);
  Observation seen{.odometry = yard.problem.start, .gun = GunState{}, .shots = {{0, true, 0.0}}};
  EXPECT_TRUE(fresh.step(seen).has_value());
  EXPECT_EQ(fresh.board().records()[0].status, TargetStatus::waiting);
  EXPECT_EQ(fresh.board().records()[1].status, TargetStatus::waiting);
}

/// A screen hides the target from the place where the robot ends up; it goes and finds another.
TEST(TaskBoard, GoesElsewhereWhenThePlaceReachedHasNoShot) {
  GuardProblem problem = three_targets();
  problem.targets.resize(1);
  problem.targets[0].base = {0, 1.5, 0};
  problem.world.solids.push_back(box_at("screen", {-2.0, 0.5, 1.5}, {1.9, 0.05, 3.0}));
  const PlannedYard yard = planned_yard(problem, coarse());
  Scripted robot(yard.problem);
  const Vec2 behind{-2.6, -0.5};
  ASSERT_FALSE(
      best_shot(yard.firing_map.rules, yard.firing_map.space(0), yard.problem.targets[0], behind, 0.0)
          .has_value());
  robot.arrive = [&](Vec2 goal, int drive) { return drive == 0 ? behind : goal; };
  // Make it drive first.
  PlannedYard moved = yard;
  moved.plan.stops[0].position = {-1.0, -1.9};
  const GuardMission mission = run(moved, robot);
  EXPECT_EQ(mission.board().records()[0].status, TargetStatus::reached);
  EXPECT_EQ(mission.board().records()[0].shots, 1);
  EXPECT_GE(robot.drives, 2);
  EXPECT_GT(distance(mission.board().records()[0].pose.position, behind), problem.errors.position_m);

  // And gives up when it always ends up there.
  Scripted lost(yard.problem);
  lost.arrive = [&](Vec2, int) { return behind; };
  const GuardMission nowhere = run(moved, lost);
  EXPECT_EQ(nowhere.board().records()[0].status, TargetStatus::failed);
  EXPECT_EQ(nowhere.board().records()[0].shots, 0);
  EXPECT_NE(nowhere.board().records()[0].reason.find("no shot from the places"), std::string::npos);
  EXPECT_EQ(nowhere.board().records()[0].pose.position, behind);
}

/// A target that has no shot with the margin is tried without it in the second pass.
TEST(TaskBoard, GivesTheMarginUpInTheSecondPass) {
  GuardProblem problem = three_targets();
  problem.targets = {{"slit", {0, 1.5, 0}, {0.4, 0.2, 0.4}, 0.0}};
  for (const double side : {-1.0, 1.0}) {
    // A slit of 5 cm lets the ball through, but not with 3 cm on both sides.
    problem.world.solids.push_back(box_at("front", {side * 1.525, 1.0, 2.5}, {3.0, 0.02, 5.0}));
    problem.world.solids.push_back(box_at("side", {side * 0.4, 1.5, 2.5}, {0.02, 1.0, 5.0}));
  }
  problem.world.solids.push_back(box_at("back", {0, 2.0, 2.5}, {6.0, 0.02, 5.0}));
  const PlannedYard yard = planned_yard(problem, coarse());
  ASSERT_EQ(yard.plan.unreachable.size(), 1U);
  Scripted robot(yard.problem);
  const GuardMission mission = run(yard, robot);
  EXPECT_EQ(mission.board().records()[0].status, TargetStatus::reached);
  ASSERT_TRUE(mission.board().records()[0].shot.has_value());
  EXPECT_LT(mission.board().records()[0].shot->clearance_m, 0.03);
  Scripted unlucky(yard.problem);
  unlucky.hits = [](std::size_t, int) { return false; };
  EXPECT_EQ(run(yard, unlucky).board().records()[0].status, TargetStatus::failed);
}

/// Whatever happens, the mission ends, each target gets one last status, and none is shot at too often.
TEST(TaskBoard, AlwaysEndsAndLosesNoTarget) {
  Rng rng(91);
  for (int y = 0; y < cases(6); ++y) {
    auto problem = random_guard_problem(rng, 8, 5, 2.0);
    if (y % 2 == 0) problem.targets[0].base.z = 8.0;
    const PlannedYard yard = planned_yard(problem, coarse());
    for (int i = 0; i < 12; ++i) {
      Rng script = rng.child(static_cast<std::uint64_t>(1000 * y + i));
      Scripted robot(yard.problem);
      const double luck = script.uniform();
      robot.hits = [&](std::size_t, int) -> std::optional<bool> {
        if (script.below(10) == 0) return {};
        return script.uniform() < luck;
      };
      robot.arrive = [&](Vec2 goal, int) {
        if (script.below(4) != 0) return goal + testing::random_offset(script, 0.0, 0.1);
        for (;;) {  // somewhere else altogether
          const std::size_t cell = script.below(yard.firing_map.frame.size());
          if (yard.firing_map.reachable[cell] != 0)
            return yard.firing_map.frame.centre(yard.firing_map.frame.cell(cell));
        }
      };
      const GuardMission mission = run(yard, robot, 500);
      std::size_t shots = 0;
      for (const TargetRecord& record : mission.board().records()) {
        EXPECT_NE(record.status, TargetStatus::waiting);
        EXPECT_FALSE(record.reason.empty());
        EXPECT_LE(record.shots, 2 * yard.problem.tries);
        EXPECT_EQ(record.status == TargetStatus::reached, record.reason.find("hit by shot") == 0);
        shots += static_cast<std::size_t>(record.shots);
      }
      EXPECT_EQ(shots, robot.fired.size());
      EXPECT_TRUE(mission.board().queue().empty());
    }
  }
}

/// A bottle on a pole at the far end, shot at by a gun that strays by 10 degrees: few shots hit.
TEST(TaskBoard, GivesUpWhatTakesTooLongToHit) {
  GuardProblem problem = three_targets();
  problem.targets = {{"bottle", {0, 2.5, 1.5}, {0.07, 0.07, 0.25}, 0.0}};
  problem.world.solids.push_back(box_at("fence", {0, -1.5, 0.25}, {6.0, 0.05, 0.5}));
  problem.errors.aim.gun_rad = radians(10);
  PlannedYard yard = planned_yard(problem, coarse());
  const auto shots_of = [&](double give_up_s) {
    yard.problem.give_up_s = give_up_s;
    Scripted robot(yard.problem);
    robot.hits = [](std::size_t, int) { return false; };
    return run(yard, robot).board().records()[0];
  };
  const TargetRecord never = shots_of(0.0);
  ASSERT_EQ(never.shots, 2 * problem.tries) << "the premise: it can be shot at";
  ASSERT_LT(never.shot->hit_rate, 0.2) << "the premise: it is hard to hit";
  const TargetRecord soon = shots_of(1.0);
  EXPECT_EQ(soon.shots, 1);
  EXPECT_EQ(soon.status, TargetStatus::failed);
  EXPECT_NE(soon.reason.find("missed 1 time; given up, as a hit from elsewhere takes"), std::string::npos)
      << soon.reason;
  // The first pass goes on as long as a hit takes less than that.
  ASSERT_GT(never.shot->hit_rate, 0.0) << "the premise: some shots hit";
  EXPECT_GE(shots_of(1.3 * never.shot->flight_s / never.shot->hit_rate).shots, problem.tries);
}

TEST(TaskBoard, NamesEveryStatus) {
  EXPECT_EQ(to_string(TargetStatus::waiting), "waiting");
  EXPECT_EQ(to_string(TargetStatus::reached), "reached");
  EXPECT_EQ(to_string(TargetStatus::failed), "failed");
  EXPECT_EQ(to_string(TargetStatus::unreachable), "unreachable");
}

}  // namespace
}  // namespace outrider
