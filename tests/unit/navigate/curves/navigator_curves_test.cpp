// A robot that steers like a car, in a closed loop with the navigator.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include "outrider/core/rng.hpp"
#include "outrider/motion/turning_path.hpp"
#include "outrider/navigate/navigator.hpp"
#include "outrider/path/pieces.hpp"
#include "outrider/sim/simulated_robot.hpp"

namespace outrider {
namespace {

NavigatorSetup small_car(double turning_radius_m) {
  NavigatorSetup setup;
  setup.robot.radius_m = 0.25;
  setup.robot.speed_mps = 0.8;
  setup.robot.acceleration_mps2 = 1.0;
  setup.robot.turn_rate_radps = 2.0;
  setup.robot.turning_radius_m = turning_radius_m;
  setup.footprint = Footprint({{{-0.2, -0.13}, {0.2, -0.13}, {0.2, 0.13}, {-0.2, 0.13}}, 0.0});
  setup.options.localiser = "odometry";
  return setup;
}

ExplorerSimParams car_devices(const NavigatorSetup& setup) {
  ExplorerSimParams params;
  params.laser.rate_hz = 20.0;
  params.laser.most_m = 8.0;
  params.footprint = setup.footprint;
  params.wheels.scale_error = 0.0;
  params.wheels.noise_m = 0.0;
  return params;
}

Solid car_box(Vec2 middle, Vec2 size) {
  return {"box", {{middle.x, middle.y, 0.5}, {}}, BoxShape{{0.5 * size.x, 0.5 * size.y, 0.5}}};
}

struct CarResult {
  Progress progress;
  Pose2 truth;
  std::int64_t contacts = 0;
  std::int64_t walked_into = 0;
  double time_s = 0.0;
  double tightest = 0.0;  ///< largest curvature of the true way, times the turning radius
};

CarResult drive_car(const World& world, const NavigatorSetup& setup, const GoTo& order, double limit_s,
                    const ExplorerSimParams& params, const Pose2& start = {}) {
  SimulatedRobot robot = simulated_explorer(world, start, setup.robot, params, 5);
  auto navigator = Navigator::make(setup, start);
  CarResult result;
  while (robot.time_s() < limit_s) {
    result.progress = navigator->perceive(robot.sense()).progress;
    if (result.progress.state != Progress::State::underway) break;
    const Pose2 before = robot.pose();
    robot.act(navigator->act(order));
    const double way_m = distance(before.position, robot.pose().position);
    const double turn_rad = std::abs(robot.pose().heading_rad - before.heading_rad);
    if (way_m > 0.01)
      result.tightest = std::max(result.tightest, turn_rad / way_m * setup.robot.turning_radius_m);
  }
  const auto& body = robot.body<TwistBody>();
  result.truth = body.pose();
  result.contacts = body.contacts();
  result.walked_into = body.walked_into();
  result.time_s = robot.time_s();
  return result;
}

void expect_there(const CarResult& result, const GoTo& order, const std::string& what) {
  EXPECT_EQ(result.progress.state, Progress::State::arrived)
      << what << ": " << result.progress.why << " at " << result.truth.position.x << ' '
      << result.truth.position.y << ' ' << result.truth.heading_rad << " after " << result.time_s;
  EXPECT_LT(distance(result.truth.position, order.place), 0.3) << what;
  if (order.heading_rad) {
    EXPECT_LT(std::abs(wrap_angle(result.truth.heading_rad - *order.heading_rad)), radians(10.0)) << what;
  }
  EXPECT_EQ(result.contacts, 0) << what;
  EXPECT_LT(result.tightest, 1.02) << what;
}

TEST(NavigatorCurves, ReachesPosesInOpenGround) {
  Rng rng(7);
  for (int i = 0; i < 6; ++i) {
    const double radius_m = i % 2 == 0 ? 0.4 : 0.8;
    const NavigatorSetup setup = small_car(radius_m);
    const GoTo order{{rng.uniform(-3.0, 3.0), rng.uniform(-3.0, 3.0)}, 0.15, rng.uniform(-pi, pi)};
    const CarResult result = drive_car({}, setup, order, 60.0, car_devices(setup));
    expect_there(result, order, std::to_string(i));
    const double ideal_m = shortest_turning_length({}, {order.place, *order.heading_rad}, radius_m, true);
    EXPECT_LT(result.time_s, 2.0 * ideal_m / setup.robot.speed_mps + 6.0) << i;
  }
}

TEST(NavigatorCurves, BacksOutOfADeadEnd) {
  World world;  // a corridor along x that is closed at its end, too narrow to turn round in
  world.solids = {car_box({1.0, 0.5}, {4.0, 0.2}), car_box({1.0, -0.5}, {4.0, 0.2}),
                  car_box({3.0, 0.0}, {0.2, 1.2})};
  const NavigatorSetup setup = small_car(0.6);
  const GoTo order{{-3.0, 0.0}, 0.15, pi};
  expect_there(drive_car(world, setup, order, 90.0, car_devices(setup), {{2.0, 0.0}, 0.0}), order, "out");
}

TEST(NavigatorCurves, ParksBetweenTwoBoxes) {
  World world;  // a row along a wall, with a gap of two and a half lengths of the robot
  world.solids = {car_box({0.0, -1.0}, {8.0, 0.2}), car_box({1.55, -0.7}, {1.6, 0.4}),
                  car_box({-1.15, -0.7}, {1.6, 0.4})};
  const NavigatorSetup setup = small_car(0.5);
  const GoTo order{{0.2, -0.65}, 0.08, 0.0};
  expect_there(drive_car(world, setup, order, 90.0, car_devices(setup), {{-2.0, 0.2}, 0.0}), order, "parks");
}

TEST(NavigatorCurves, SaysThatItsRadiusIsTooLarge) {
  World world;  // a lane with a corner that is too tight for it, and no other way
  world.solids = {car_box({1.5, 0.45}, {5.1, 0.1}), car_box({1.15, -0.45}, {4.4, 0.1}),
                  car_box({-1.0, 0.0}, {0.1, 1.0}), car_box({4.1, -1.4}, {0.1, 3.8}),
                  car_box({3.3, -1.8}, {0.1, 2.8}), car_box({3.7, -3.2}, {0.9, 0.1})};
  NavigatorSetup setup = small_car(20.0);
  setup.options.most_recoveries = 3;
  const GoTo order{{3.7, -2.5}, 0.15, -0.5 * pi};
  const CarResult result = drive_car(world, setup, order, 120.0, car_devices(setup));
  EXPECT_EQ(result.progress.state, Progress::State::blocked) << result.time_s;
  EXPECT_NE(result.progress.why.find("turning radius of 20 m"), std::string::npos) << result.progress.why;
  EXPECT_EQ(result.contacts, 0);
}

TEST(NavigatorCurves, FollowsATrackWithAChangeOfDirection) {
  auto track = std::make_shared<TrackPieces>();
  track->push_back({{0.0, 0.0}, {2.0, 0.0}, {}, 0.0, false});
  track->push_back({{2.0, 0.0}, {2.8, 0.8}, {2.0, 0.8}, 0.5 * pi, false});
  track->push_back({{2.8, 0.8}, {2.8, -0.6}, {}, 0.0, true});
  const NavigatorSetup setup = small_car(0.7);
  SimulatedRobot robot = simulated_explorer({}, {}, setup.robot, car_devices(setup), 5);
  auto navigator = Navigator::make(setup, Pose2{});
  const Follow order{track};
  Progress progress;
  double off_m = 0.0;
  while (robot.time_s() < 30.0) {
    progress = navigator->perceive(robot.sense()).progress;
    if (progress.state != Progress::State::underway) break;
    robot.act(navigator->act(order));
    const Vec2 here = robot.pose().position;
    double nearest_m = 1.0;
    for (const PathPiece& piece : *track)
      nearest_m = std::min(nearest_m, distance(here, point_on(piece, nearest_part(piece, here))));
    off_m = std::max(off_m, nearest_m);
  }
  EXPECT_EQ(progress.state, Progress::State::arrived);
  EXPECT_TRUE(navigator->track()->left_out().empty());
  EXPECT_LT(off_m, 0.05);
  EXPECT_LT(distance(robot.pose().position, Vec2{2.8, -0.6}), 0.05);
  EXPECT_NEAR(robot.pose().heading_rad, 0.5 * pi, 0.05);
}

TEST(NavigatorCurves, DrivesAmongWalkers) {
  World world;
  world.bounds = {{-4.0, -3.0}, {12.0, 3.0}};
  world.solids = {car_box({4.0, 3.0}, {16.0, 0.2}), car_box({4.0, -3.0}, {16.0, 0.2}),
                  car_box({-4.0, 0.0}, {0.2, 6.0}), car_box({12.0, 0.0}, {0.2, 6.0})};
  for (int i = 0; i < 2; ++i) {
    const NavigatorSetup setup = small_car(0.6);
    ExplorerSimParams params = car_devices(setup);
    params.faults.walk_ins.people = 4;
    params.faults.walk_ins.people_mps = 0.5;
    const GoTo order{{9.0, i % 2 == 0 ? 1.0 : -1.0}, 0.15, i % 2 == 0 ? pi : 0.0};
    expect_there(drive_car(world, setup, order, 120.0, params), order, std::to_string(i));
  }
}

}  // namespace
}  // namespace outrider
