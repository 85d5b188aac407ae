// A navigator in a closed loop with a simulated robot whose laser sees what no map has.
#include "outrider/navigate/navigator.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "outrider/sim/simulated_robot.hpp"

namespace outrider {
namespace {

NavigatorSetup small_robot() {
  NavigatorSetup setup;
  setup.robot.radius_m = 0.25;
  setup.robot.speed_mps = 1.0;
  setup.robot.acceleration_mps2 = 2.0;
  setup.robot.turn_rate_radps = 2.0;
  setup.footprint = Footprint({{{-0.2, -0.15}, {0.2, -0.15}, {0.2, 0.15}, {-0.2, 0.15}}, 0.0});
  return setup;
}

ExplorerSimParams devices(const NavigatorSetup& setup) {
  ExplorerSimParams params;
  params.laser.rate_hz = 20.0;
  params.laser.most_m = 8.0;
  params.footprint = setup.footprint;
  return params;
}

Solid box_at(Vec2 middle, Vec2 size) {
  return {"box", {{middle.x, middle.y, 0.5}, {}}, BoxShape{{0.5 * size.x, 0.5 * size.y, 0.5}}};
}

struct Result {
  Progress progress;
  Pose2 truth;
  std::int64_t contacts = 0;
  double time_s = 0.0;
};

Result drive(const World& world, const NavigatorSetup& setup, Vec2 goal, double limit_s,
             const ExplorerSimParams& params) {
  SimulatedRobot robot = simulated_explorer(world, {}, setup.robot, params, 5);
  auto navigator = Navigator::make(setup, Pose2{});
  Result result;
  while (robot.time_s() < limit_s) {
    result.progress = navigator->perceive(robot.sense()).progress;
    if (result.progress.state != Progress::State::underway) break;
    robot.act(navigator->act(GoTo{goal, 0.15, 0.0}));
  }
  const auto& body = robot.body<TwistBody>();
  return {result.progress, body.pose(), body.contacts(), robot.time_s()};
}

TEST(Navigator, DrivesAroundWhatNobodyToldItOf) {
  World world;
  world.solids = {box_at({2.0, 0.0}, {0.4, 2.0}), box_at({4.0, 1.5}, {0.4, 3.0}),
                  box_at({0.0, -5.0}, {12.0, 0.2})};
  for (const std::string localiser : {"odometry", "laser_mapping"}) {
    NavigatorSetup setup = small_robot();
    setup.options.localiser = localiser;
    const Result result = drive(world, setup, {6.0, 0.0}, 60.0, devices(setup));
    EXPECT_EQ(result.progress.state, Progress::State::arrived) << localiser << result.progress.why;
    EXPECT_LT(distance(result.truth.position, Vec2{6.0, 0.0}), localiser == "odometry" ? 1.0 : 0.3)
        << localiser;
    EXPECT_EQ(result.contacts, 0) << localiser;
    EXPECT_LT(result.time_s, 20.0) << localiser;
  }
}

/// A robot in a passage in which it cannot turn sees somebody who walks to and fro ahead of it, and is then
/// sent back. Returns its least speed in the next seconds.
double least_speed_mps(double view_rad, double walks_m) {
  World world;
  world.solids = {box_at({0.0, 0.4}, {3.0, 0.2}), box_at({0.0, -0.4}, {3.0, 0.2}),
                  box_at({9.0, 0.0}, {0.2, 8.0}), box_at({-6.0, 0.0}, {0.2, 8.0})};
  NavigatorSetup setup = small_robot();
  setup.footprint = Footprint({{{-0.3, -0.15}, {0.3, -0.15}, {0.3, 0.15}, {-0.3, 0.15}}, 0.0});
  ExplorerSimParams params = devices(setup);
  params.laser.view_rad = view_rad;
  params.faults.walk_ins.posts = {{{{walks_m, -0.5}, {walks_m, 0.5}}, 0.8, 0.2}};
  SimulatedRobot robot = simulated_explorer(world, {}, setup.robot, params, 5);
  auto navigator = Navigator::make(setup, Pose2{});
  double least_mps = 0.0;
  while (robot.time_s() < 5.0) {
    navigator->perceive(robot.sense());
    const Order order = robot.time_s() < 2.0 ? Order(Hold{}) : Order(GoTo{{-2.0, 0.0}, 0.15});
    robot.act(navigator->act(order));
    least_mps = std::min(least_mps, robot.body<TwistBody>().twist().ahead_mps);
  }
  return least_mps;
}

TEST(Navigator, DoesNotBackOutOfSightWhereSomebodyIsAbout) {
  constexpr double whole = 2.0 * pi, before = 1.5 * pi;
  EXPECT_LT(least_speed_mps(whole, 2.0), -0.3);
  EXPECT_LT(least_speed_mps(before, 6.0), -0.3);
  EXPECT_GT(least_speed_mps(before, 2.0), -0.01);
}

TEST(Navigator, SaysThatThereIsNoWay) {
  World world;
  const double side = 4.0;
  world.solids = {box_at({side, 0.0}, {0.2, 2.0 * side}), box_at({-side, 0.0}, {0.2, 2.0 * side}),
                  box_at({0.0, side}, {2.0 * side, 0.2}), box_at({0.0, -side}, {2.0 * side, 0.2})};
  NavigatorSetup setup = small_robot();
  setup.options.most_recoveries = 3;
  const Result result = drive(world, setup, {7.0, 0.0}, 120.0, devices(setup));
  EXPECT_EQ(result.progress.state, Progress::State::blocked);
  EXPECT_NE(result.progress.why.find("(7.00, 0.00)"), std::string::npos) << result.progress.why;
  EXPECT_EQ(result.contacts, 0);
}

TEST(Navigator, GivesUpAHeadingThatItCannotTurnTo) {
  World world;
  world.solids = {box_at({2.0, 0.31}, {6.0, 0.2}), box_at({2.0, -0.31}, {6.0, 0.2}),
                  box_at({4.5, 0.0}, {0.2, 2.0})};
  NavigatorSetup setup = small_robot();
  setup.options.most_recoveries = 3;
  SimulatedRobot robot = simulated_explorer(world, {{-1.5, 0.0}, 0.0}, setup.robot, devices(setup), 5);
  auto navigator = Navigator::make(setup, Pose2{{-1.5, 0.0}, 0.0});
  Progress progress;
  while (robot.time_s() < 300.0 && progress.state == Progress::State::underway) {
    progress = navigator->perceive(robot.sense()).progress;
    robot.act(navigator->act(GoTo{{2.0, 0.0}, 0.15, pi}));
  }
  EXPECT_EQ(progress.state, Progress::State::blocked)
      << robot.pose().position.x << ' ' << robot.pose().heading_rad;
  EXPECT_EQ(robot.body<TwistBody>().contacts(), 0);
}

TEST(Navigator, IsLostWhenNoScanComesAnyMore) {
  NavigatorSetup setup = small_robot();
  ExplorerSimParams params = devices(setup);
  params.faults.blind_from_s = 1.0;
  const Result result = drive({}, setup, {6.0, 0.0}, 120.0, params);
  EXPECT_EQ(result.progress.state, Progress::State::lost);
  EXPECT_GT(result.time_s, 60.0) << "it waits";
  EXPECT_LT(result.time_s, 65.0);
  params.faults.blind_from_s = 0.0;
  EXPECT_EQ(drive({}, setup, {6.0, 0.0}, 120.0, params).progress.state, Progress::State::lost);
}

TEST(Navigator, StandsWithoutScans) {
  World world;
  NavigatorSetup setup = small_robot();
  ExplorerSimParams params = devices(setup);
  params.faults.blind_from_s = 1.0;
  const Result result = drive(world, setup, {6.0, 0.0}, 10.0, params);
  EXPECT_EQ(result.progress.state, Progress::State::underway);
  EXPECT_GT(result.truth.position.x, 0.1);
  EXPECT_LT(result.truth.position.x, 2.5);
}

TEST(Navigator, BearsObservationsThatMakeNoSense) {
  auto navigator = Navigator::make(small_robot(), Pose2{});
  Observation seen;
  const double nan = std::nan("");
  for (int i = 0; i < 50; ++i) {
    seen.time_s = i % 7 == 3 ? 0.0 : 0.05 * i;  // the clock jumps back
    seen.odometry = i % 5 == 2 ? Pose2{{nan, 0.0}, nan} : Pose2{{0.01 * i, 0.0}, 0.0};
    seen.scan = LaserScan{seen.time_s, 0.0, 0.1, 0.1, 5.0, std::vector<float>(i % 3 == 0 ? 0 : 63, 3.0F)};
    const Situation now = navigator->perceive(seen);
    EXPECT_TRUE(finite(now.pose)) << i;
    const Command command = navigator->act(GoTo{{2.0, 0.0}});
    const Twist2 twist = std::get<DriveTwist>(command).twist;
    EXPECT_TRUE(std::isfinite(twist.ahead_mps) && std::isfinite(twist.turn_radps)) << i;
  }
}

TEST(Navigator, TakesAWrappedHeadingForNoWholeTurn) {
  auto navigator = Navigator::make(small_robot(), Pose2{});
  Observation seen;
  for (int i = 0; i < 100; ++i) {
    seen.time_s = 0.05 * i;
    seen.odometry = {{0.02 * i, 0.0}, wrap_angle(3.0 + 0.01 * i)};
    const Twist2 twist = navigator->perceive(seen).twist;
    navigator->act(Hold{});
    EXPECT_LT(std::abs(twist.ahead_mps), 0.5) << i;
    EXPECT_LT(std::abs(twist.turn_radps), 0.3) << i;
  }
}

TEST(Navigator, GoesOnWhenTheClockIsPutBack) {
  auto navigator = Navigator::make(small_robot(), Pose2{});
  Observation seen;
  for (int i = 0; i < 60; ++i) {
    seen.time_s = (i < 30 ? 1000.0 : 0.0) + 0.05 * i;
    seen.scan = LaserScan{seen.time_s, 0.0, 0.1, 0.1, 5.0, std::vector<float>(63, 3.0F)};
    EXPECT_NEAR(navigator->perceive(seen).time_s, seen.time_s, 1e-9);
    const auto command = std::get<DriveTwist>(navigator->act(GoTo{{2.0, 0.0}}));
    EXPECT_NEAR(command.until_s, seen.time_s + 0.05, 1e-9);
    EXPECT_GE(command.twist.ahead_mps, i > 0 ? 1e-3 : 0.0) << i;
  }
}

TEST(Navigator, SaysThatAnOrderIsNoPlace) {
  auto navigator = Navigator::make(small_robot(), Pose2{});
  Observation seen;
  seen.scan = LaserScan{0.0, 0.0, 0.1, 0.1, 5.0, std::vector<float>(63, 3.0F)};
  navigator->perceive(seen);
  for (const GoTo& order : {GoTo{{std::nan(""), 0.0}}, GoTo{{1e9, 0.0}}, GoTo{{1.0, 0.0}, -1.0}}) {
    EXPECT_EQ(std::get<DriveTwist>(navigator->act(order)).twist, Twist2{});
    const Situation now = navigator->perceive(seen);
    EXPECT_EQ(now.progress.state, Progress::State::blocked);
    EXPECT_NE(now.progress.why.find("no place"), std::string::npos) << now.progress.why;
    navigator->act(GoTo{{2.0, 0.0}});
    EXPECT_EQ(navigator->perceive(seen).progress.state, Progress::State::underway);
  }
}

TEST(Navigator, RefusesUnknownRows) {
  NavigatorSetup setup = small_robot();
  setup.motion.rule = "sample";
  const auto refused = Navigator::make(setup, Pose2{});
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().sentence.find("sampled"), std::string::npos) << refused.error().sentence;
  setup.motion.rule = "dwa";
  setup.options.localiser = "gps";
  EXPECT_FALSE(Navigator::make(setup, Pose2{}));
}

TEST(Navigator, StandsWhenItIsBlindByAnyRule) {
  for (const std::string& rule : names_of(local_motions())) {
    NavigatorSetup setup = small_robot();
    setup.motion.rule = rule;
    auto navigator = Navigator::make(setup, Pose2{});
    ASSERT_TRUE(navigator);
    Progress::State end = Progress::State::underway;
    for (double time_s = 0.0; time_s < 65.0; time_s += 0.05) {
      Observation seen;
      seen.time_s = time_s;
      end = navigator->perceive(seen).progress.state;
      const Command command = navigator->act(GoTo{{3.0, 0.0}});
      EXPECT_EQ(std::get<DriveTwist>(command).twist, Twist2{}) << rule;
    }
    EXPECT_EQ(end, Progress::State::lost) << rule;
  }
}

}  // namespace
}  // namespace outrider
