// The contract of the rules of motion: whatever stands around a robot, what they command never leads it where
// it could not brake, and on open ground they arrive.
#include "outrider/navigate/local_motion.hpp"

#include <gtest/gtest.h>

#include "outrider/core/rng.hpp"

namespace outrider {
namespace {

const Footprint body({{{-0.21, -0.165}, {0.21, -0.165}, {0.21, 0.165}, {-0.21, 0.165}}, 0.0});

RobotModel quick_robot() {
  RobotModel robot;
  robot.speed_mps = 1.5;
  robot.acceleration_mps2 = 2.0;
  robot.turn_rate_radps = 2.0;
  return robot;
}

/// A robot that obeys exactly among marks that do not change.
struct ObedientRobot {
  LiveMap map = LiveMap(LiveMapOptions{}, Vec2{});
  RobotModel robot = quick_robot();
  Pose2 pose;
  Twist2 twist;
  double nearest_m = 1.0;  ///< gap so far

  /// Drives until it arrives or the time is over; returns whether it arrived.
  bool to(Vec2 goal, LocalMotion& rule, double limit_s) {
    GoalField field;
    field.compute({map.frame(), map.places()}, body, robot, {goal}, pose.position);
    Surroundings near;
    for (double t = 0.0; t < limit_s; t += 0.05) {
      near.look(map, pose.position, 4.0);
      near.find_distances();
      const MotionState state{pose, twist, body, robot, near, field, goal};
      const Twist2 chosen = rule.choose(state);
      for (int i = 0; i < 10; ++i) {
        const Twist2 next = twist_after(twist, chosen, robot, 0.005);
        pose = moved_evenly(pose, twist, next, 0.005);
        twist = next;
        for (const Mark& mark : map.marks())
          nearest_m = std::min(nearest_m, body.gap_m(pose.to_local(mark.place)));
      }
      if (distance(pose.position, goal) < 0.1) return true;
    }
    return false;
  }
};

class EachRule : public ::testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<LocalMotion> rule() { return find_row(local_motions(), "rule", GetParam(), "")->make({}); }
};

TEST_P(EachRule, ArrivesOnOpenGround) {
  for (const Vec2 goal : {Vec2{3.0, 0.0}, Vec2{-2.0, 1.0}, Vec2{0.0, -2.5}}) {
    ObedientRobot one;
    EXPECT_TRUE(one.to(goal, *rule(), 15.0)) << goal.x << ' ' << goal.y;
  }
}

TEST(Steer, DrivesTheArcToWhereItAims) {
  const ObedientRobot one;
  const Vec2 goal{0.5, 0.1};  // nearer than it looks ahead
  GoalField field;
  field.compute({one.map.frame(), one.map.places()}, body, one.robot, {goal}, one.pose.position);
  Surroundings near;
  near.look(one.map, one.pose.position, 4.0);
  near.find_distances();
  const auto steer = find_row(local_motions(), "rule", "steer", "")->make({});
  const Twist2 chosen = steer->choose({one.pose, {}, body, one.robot, near, field, goal});
  ASSERT_GT(chosen.ahead_mps, 0.0);
  const double radius_m = chosen.ahead_mps / chosen.turn_radps;
  EXPECT_NEAR(distance(goal, Vec2{0.0, radius_m}), radius_m, 1e-9);
}

TEST_P(EachRule, NeverTouchesWhatIsMarked) {
  Rng rng(7);
  for (int world = 0; world < 12; ++world) {
    ObedientRobot one;
    for (int i = 0; i < 60; ++i) {
      const Vec2 place{rng.uniform(-1.0, 6.0), rng.uniform(-2.5, 2.5)};
      if (norm(place) > 0.5) one.map.note_touch(place, 0.0);
    }
    one.to({5.0, 0.0}, *rule(), 8.0);
    EXPECT_GT(one.nearest_m, 0.0) << world;
  }
}

TEST_P(EachRule, GivesTheSameCommandsAgain) {
  const auto end = [&] {
    ObedientRobot one;
    one.map.note_touch({1.5, 0.1}, 0.0);
    one.to({3.0, 0.0}, *rule(), 2.0);
    return one.pose;
  };
  EXPECT_EQ(end(), end());
}

TEST_P(EachRule, CommandsAreFiniteAndWithinTheLimits) {
  Rng rng(23);
  const auto one = rule();
  for (int i = 0; i < 60; ++i) {
    ObedientRobot any;
    for (int k = 0; k < 40; ++k) any.map.note_touch({rng.uniform(-3, 3), rng.uniform(-3, 3)}, 0.0);
    any.robot.speed_mps = rng.uniform(0.05, 2.0);  // that of a slow zone may change at once
    const Vec2 goal{rng.uniform(-4, 4), rng.uniform(-4, 4)};
    GoalField field;
    if (i % 4 != 0) field.compute({any.map.frame(), any.map.places()}, body, any.robot, {goal}, Vec2{});
    Surroundings near;
    near.look(any.map, {}, 4.0);
    near.find_distances();
    const Twist2 now{rng.uniform(-0.5, 1.5), 0.0, rng.uniform(-2.0, 2.0)};
    const Twist2 chosen = one->choose({{{}, rng.uniform(-3, 3)}, now, body, any.robot, near, field, goal});
    EXPECT_TRUE(std::isfinite(chosen.ahead_mps) && std::isfinite(chosen.turn_radps));
    EXPECT_EQ(chosen.left_mps, 0.0);
    EXPECT_LE(std::abs(chosen.ahead_mps), any.robot.speed_mps + 1e-9);
    EXPECT_LE(std::abs(chosen.turn_radps), any.robot.turn_rate_radps + 1e-9);
  }
}

TEST_P(EachRule, DoesNotDriveBackwardsWhereItMayNot) {
  Rng rng(29);
  int backwards = 0;
  for (int i = 0; i < 60; ++i) {
    ObedientRobot any;
    for (int k = 0; k < 20; ++k) any.map.note_touch({0.3, rng.uniform(-1.0, 1.0)}, 0.0);
    const Vec2 goal{rng.uniform(-3.0, -1.0), rng.uniform(-1.0, 1.0)};
    GoalField field;
    field.compute({any.map.frame(), any.map.places()}, body, any.robot, {goal}, Vec2{});
    Surroundings near;
    near.look(any.map, {}, 4.0);
    near.find_distances();
    MotionState state{{}, {}, body, any.robot, near, field, goal};
    backwards += rule()->choose(state).ahead_mps < 0.0;
    state.may_back = false;
    EXPECT_GE(rule()->choose(state).ahead_mps, 0.0);
    EXPECT_FALSE(can_brake(state, {-0.1, 0.0, 0.0}, 0.03));
  }
  EXPECT_TRUE(backwards > 0 || GetParam() != "sampled");
}

INSTANTIATE_TEST_SUITE_P(LocalMotions, EachRule, ::testing::ValuesIn(names_of(local_motions())),
                         [](const auto& info) { return std::string(info.param); });

TEST(LocalMotion, BrakingIsForeseen) {
  LiveMap map({}, {});
  map.note_touch({1.0, 0.0}, 0.0);
  Surroundings near;
  near.look(map, {}, 3.0);
  near.find_distances();
  const GoalField none;
  const RobotModel robot = quick_robot();
  const auto brakes_at = [&](double speed_mps) {
    return can_brake({{}, {speed_mps, 0.0, 0.0}, body, robot, near, none, {}}, {speed_mps, 0.0, 0.0}, 0.0);
  };
  // It has 0.79 m; at v it needs 0.05 s v + v^2 / 4 m.
  EXPECT_TRUE(brakes_at(1.5));
  EXPECT_TRUE(
      can_brake({{{0.2, 0.0}, 0.0}, {1.4, 0.0, 0.0}, body, robot, near, none, {}}, {1.4, 0.0, 0.0}, 0.0));
  EXPECT_FALSE(
      can_brake({{{0.3, 0.0}, 0.0}, {1.5, 0.0, 0.0}, body, robot, near, none, {}}, {1.5, 0.0, 0.0}, 0.0));
}

TEST(LocalMotion, TheSweepOfATurnIsForeseen) {
  LiveMap map({}, {});
  map.note_touch({0.15, 0.2}, 0.0);  // beside the robot, within reach of its corners
  Surroundings near;
  near.look(map, {}, 3.0);
  near.find_distances();
  const GoalField none;
  const RobotModel robot = quick_robot();
  EXPECT_FALSE(can_brake({{}, {0.0, 0.0, 1.5}, body, robot, near, none, {}}, {0.0, 0.0, 2.0}, 0.0));
  EXPECT_TRUE(can_brake({{}, {}, body, robot, near, none, {}}, {0.3, 0.0, 0.0}, 0.0));
}

}  // namespace
}  // namespace outrider
