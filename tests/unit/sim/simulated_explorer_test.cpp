#include "outrider/sim/simulated_robot.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "outrider/jobs/explore/mission/task.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

using testing::cases;

World walls(const std::vector<Segment>& segments) {
  World world;
  for (const Segment& s : segments) {
    const Vec2 middle = 0.5 * (s.a + s.b);
    world.solids.push_back({"wall",
                            {{middle.x, middle.y, 0.25}, Rotation::from_rpy(0, 0, heading_of(s.b - s.a))},
                            BoxShape{{0.5 * distance(s.a, s.b), 0.0, 0.25}}});
  }
  return world;
}

ExplorerSimParams faultless() {
  ExplorerSimParams params;
  params.wheels.scale_error = params.wheels.noise_m = 0.0;
  return params;
}

void drive(SimulatedRobot& robot, const Twist2& twist, double duration_s) {
  robot.act(DriveTwist{twist, robot.time_s() + duration_s});
}

constexpr Twist2 ahead{0.22, 0.0, 0.0};

TEST(SimulatedExplorer, AWallStopsItWhereItTouches) {
  const RobotModel robot = burger();
  SimulatedRobot it = simulated_explorer(walls({{{1.0, -2.0}, {1.0, 2.0}}}), {}, robot, faultless(), 1);
  EXPECT_FALSE(it.sense().touching);
  drive(it, ahead, 10.0);
  EXPECT_NEAR(it.pose().position.x, 1.0 - robot.radius_m, 1e-6);
  EXPECT_EQ(it.body<TwistBody>().contacts(), 1) << "pushing on is one touch";
  const Observation seen = it.sense();
  EXPECT_TRUE(seen.touching);
  EXPECT_GT(seen.odometry.position.x, 2.0) << "the wheels slip and count on";
  drive(it, {0.0, 0.0, 1.0}, 1.0);
  drive(it, {-0.1, 0.0, 0.0}, 1.0);
  EXPECT_TRUE(it.sense().touching) << "since it sensed last";
  drive(it, {-0.1, 0.0, 0.0}, 1.0);
  EXPECT_FALSE(it.sense().touching);
  drive(it, ahead, 10.0);
  EXPECT_EQ(it.body<TwistBody>().contacts(), 2);
}

/// A person who carries a robot puts it down beside a wall, not against it, and it stands there.
TEST(SimulatedExplorer, AKidnappedRobotStandsWithRoomAroundIt) {
  const RobotModel robot = burger();
  ExplorerSimParams params = faultless();
  params.faults.kidnapping = {1.0, 1.0, 0.5};
  const auto gap_m = [&](const SimulatedRobot& it, double wall_m) {
    return std::abs(wall_m - it.pose().position.y) - robot.radius_m;
  };
  for (const double side : {-0.5, 0.7, 1.0, 1.15, 1.25}) {  // the first is not on the way
    SCOPED_TRACE(side);
    SimulatedRobot it = simulated_explorer(walls({{{-2.0, side}, {4.0, side}}}), {}, robot, params, 1);
    drive(it, ahead, 1.0);
    EXPECT_EQ(it.body<TwistBody>().twist(), Twist2{});
    EXPECT_GE(gap_m(it, side), 0.1);
    EXPECT_NEAR(it.pose().heading_rad, 0.5, 1e-9);
    if (side < 0.0) {
      EXPECT_NEAR(it.pose().position.y, 1.0, 1e-9);
    }
    drive(it, ahead, 0.2);
    EXPECT_EQ(it.body<TwistBody>().contacts(), 0);
  }
  // A robot that stands too near already, and would where it is put, is turned where it is.
  params.faults.kidnapping.by_m = 0.02;
  SimulatedRobot near = simulated_explorer(walls({{{-2.0, 0.15}, {4.0, 0.15}}}), {}, robot, params, 1);
  drive(near, ahead, 1.0);
  EXPECT_EQ(near.pose().position.y, 0.0);
  EXPECT_NEAR(near.pose().heading_rad, 0.5, 1e-9);
}

TEST(SimulatedExplorer, NeverDrivesIntoAnything) {
  Rng rng(7);
  for (int i = 0; i < cases(4); ++i) {
    World world;
    for (int k = 0; k < 12; ++k) {
      const Vec2 p = testing::random_point(rng, 1.5);
      const Rotation turn = Rotation::from_rpy(0, 0, rng.uniform(0, pi));
      const Shape shape = rng.below(2) == 0 ? Shape{BoxShape{{0.3 * rng.uniform(), 0.3 * rng.uniform(), 0.1}}}
                                            : Shape{CylinderShape{0.2 * rng.uniform(), 0.1}};
      world.solids.push_back({"solid", {{p.x, p.y, 0.1}, turn}, shape});
    }
    RobotModel robot = burger();
    robot.speed_mps = 5.0;
    robot.acceleration_mps2 = 50.0;
    const auto gap = [&](Vec2 p) {
      double nearest = 10.0;
      for (const RoundedPolygon& piece : cut_at(world, 0.1))
        nearest = std::min(nearest, signed_distance(p, piece));
      return nearest - robot.radius_m;
    };
    Pose2 start;
    while (gap(start.position) < 0.0) start.position = testing::random_point(rng, 1.5);
    SimulatedRobot it = simulated_explorer(world, start, robot, {}, rng.bits());
    for (int k = 0; k < 60; ++k) {
      drive(it, {rng.uniform(-5.0, 5.0), 0.0, rng.uniform(-3.0, 3.0)}, 0.05);
      ASSERT_GT(gap(it.pose().position), -1e-6);
      EXPECT_NEAR(it.body<TwistBody>().ground().gap_m(it.pose().position),
                  std::min(1.0, gap(it.pose().position)), 1e-9);
    }
  }
}

TEST(SimulatedExplorer, DrivesOverWhatItsWheelsClimb) {
  World world;
  world.solids.push_back({"foot", {{0.5, 0.0, 0.02}, {}}, BoxShape{{0.1, 0.1, 0.02}}});
  ExplorerSimParams params = faultless();
  SimulatedRobot over = simulated_explorer(world, {}, burger(), params, 1);
  drive(over, ahead, 5.0);
  EXPECT_EQ(over.body<TwistBody>().contacts(), 0);
  params.wheels.climbs_m = 0.01;
  SimulatedRobot against = simulated_explorer(world, {}, burger(), params, 1);
  drive(against, ahead, 5.0);
  EXPECT_EQ(against.body<TwistBody>().contacts(), 1);
}

TEST(SimulatedExplorer, KeepsItsLimits) {
  SimulatedRobot it = simulated_explorer(World{}, {}, burger(), faultless(), 1);
  drive(it, {5.0, 3.0, 9.0}, 0.05);
  EXPECT_NEAR(it.body<TwistBody>().twist().ahead_mps, 0.125, 1e-9) << "2.5 m/s2";
  EXPECT_NEAR(it.body<TwistBody>().twist().turn_radps, 0.16, 1e-9) << "3.2 rad/s2";
  EXPECT_EQ(it.body<TwistBody>().twist().left_mps, 0.0);
  drive(it, {5.0, 3.0, 9.0}, 5.0);
  EXPECT_NEAR(it.body<TwistBody>().twist().ahead_mps, 0.22, 1e-9);
  EXPECT_NEAR(it.body<TwistBody>().twist().turn_radps, 2.84, 1e-9);
}

TEST(SimulatedExplorer, WithoutFaultsItsOdometryIsItsWay) {
  const Pose2 start{{3.0, -2.0}, 0.7};
  SimulatedRobot it = simulated_explorer(World{}, start, burger(), faultless(), 1);
  Rng rng(3);
  for (int i = 0; i < 50; ++i) drive(it, {rng.uniform(-0.2, 0.2), 0.0, rng.uniform(-2.0, 2.0)}, 0.3);
  const Pose2 counted = compose(start, it.sense().odometry);
  EXPECT_NEAR(distance(counted.position, it.pose().position), 0.0, 1e-9);
  EXPECT_NEAR(counted.heading_rad, it.pose().heading_rad, 1e-9);
}

/// The spread of the heading that is counted after 4 m straight on.
double heading_spread(const ExplorerWheels& wheels, int runs) {
  RobotModel robot = burger();
  robot.speed_mps = 4.0;
  robot.acceleration_mps2 = 1e3;
  ExplorerSimParams params;
  params.wheels = wheels;
  double squares = 0.0;
  for (int seed = 0; seed < runs; ++seed) {
    SimulatedRobot it = simulated_explorer(World{}, {}, robot, params, static_cast<std::uint64_t>(seed));
    drive(it, {4.0, 0.0, 0.0}, 1.0);
    const double error = it.sense().odometry.heading_rad;
    squares += error * error;
  }
  return std::sqrt(squares / runs);
}

TEST(SimulatedExplorer, ItsOdometryDriftsAsSaid) {
  const int runs = cases(400);
  const double length_m = 4.0;
  ExplorerWheels scale;
  scale.noise_m = 0.0;
  ExplorerWheels noise;
  noise.scale_error = 0.0;
  const double by_scale = std::sqrt(2.0) * scale.scale_error * length_m / scale.track_m;
  const double by_noise = std::sqrt(2.0 * length_m) * noise.noise_m / noise.track_m;
  EXPECT_NEAR(heading_spread(scale, runs) / by_scale, 1.0, 0.12);
  EXPECT_NEAR(heading_spread(noise, runs) / by_noise, 1.0, 0.12);
}

TEST(SimulatedExplorer, ScansAtItsRateFromWhereItIs) {
  ExplorerSimParams params = faultless();
  params.laser.noise_m = 0.0;
  params.laser.robot_T_laser.position.x = 0.05;
  SimulatedRobot it = simulated_explorer(walls({{{1.0, -9.0}, {1.0, 9.0}}}), {}, burger(), params, 1);
  int scans = 0;
  for (int i = 0; i <= 40; ++i) {
    const Observation seen = it.sense();
    if (seen.scan) {
      ++scans;
      EXPECT_EQ(seen.scan->time_s, seen.time_s);
      EXPECT_NEAR(static_cast<double>(seen.scan->ranges_m[0]), 0.95 - it.pose().position.x, 1e-6);
    }
    it.act(DriveTwist{{0.1, 0.0, 0.0}, 0.05 * (i + 1)});
  }
  EXPECT_EQ(scans, 11) << "5 Hz from 0 to 2 s";
}

TEST(SimulatedExplorer, SameSeedSameObservations) {
  const auto run = [](std::uint64_t seed) {
    SimulatedRobot it = simulated_explorer(walls({{{1.0, -2.0}, {1.0, 2.0}}}), {}, burger(), {}, seed);
    std::vector<double> seen;
    for (int i = 1; i <= 40; ++i) {
      const Observation now = it.sense();
      seen.insert(seen.end(), {now.odometry.position.x, now.odometry.heading_rad});
      if (now.scan) seen.insert(seen.end(), now.scan->ranges_m.begin(), now.scan->ranges_m.end());
      it.act(DriveTwist{{0.2, 0.0, 0.1}, 0.2 * i});
    }
    return seen;
  };
  EXPECT_EQ(run(5), run(5));
  EXPECT_NE(run(5), run(6));
}

TEST(SimulatedExplorer, APostIsPutBeforeItAndTakenAway) {
  const RobotModel robot = burger();
  ExplorerSimParams params = faultless();
  params.laser.noise_m = 0.0;
  params.faults.walk_ins.blocked_at_s = 1.0;
  params.faults.walk_ins.blocked_for_s = 20.0;
  SimulatedRobot it = simulated_explorer(walls({{{9.0, -2.0}, {9.0, 2.0}}}), {}, robot, params, 1);
  drive(it, {}, 2.0);
  EXPECT_FALSE(it.body<TwistBody>().walk_ins().blocked_s()) << "it stands";
  drive(it, ahead, 0.3);
  const auto& disks = it.body<TwistBody>().walk_ins().disks();
  ASSERT_EQ(disks.size(), 1u);
  const double x = disks.front().core.front().x, radius_m = disks.front().radius_m;
  EXPECT_GT(x, robot.radius_m + params.faults.walk_ins.blocked_ahead_m + radius_m - 1e-9);
  const Observation seen = it.sense();
  ASSERT_TRUE(seen.scan);
  EXPECT_NEAR(static_cast<double>(seen.scan->ranges_m.front()), x - radius_m - it.pose().position.x, 1e-6);
  drive(it, ahead, 10.0);
  EXPECT_NEAR(it.pose().position.x, x - radius_m - robot.radius_m, 1e-6);
  EXPECT_EQ(it.body<TwistBody>().contacts(), 1);
  drive(it, ahead, 20.0);
  EXPECT_GT(it.pose().position.x, x) << "it was taken away";
}

TEST(SimulatedExplorer, APostAtAPlaceWaitsUntilTheRobotIsOffIt) {
  ExplorerSimParams params = faultless();
  params.faults.walk_ins.blocked_at_s = 1.0;
  params.faults.walk_ins.blocked_place = Vec2{0.2, 0.0};
  SimulatedRobot it = simulated_explorer(walls({{{9.0, -2.0}, {9.0, 2.0}}}), {}, burger(), params, 1);
  const auto& walk_ins = it.body<TwistBody>().walk_ins();
  drive(it, {}, 3.0);
  EXPECT_FALSE(walk_ins.blocked_s()) << "the robot stands there";
  drive(it, ahead, 10.0);
  ASSERT_TRUE(walk_ins.blocked_s());
  EXPECT_GT(*walk_ins.blocked_s(), 3.0);
  ASSERT_EQ(walk_ins.disks().size(), 1u);
  EXPECT_EQ(walk_ins.disks().front().core.front(), (Vec2{0.2, 0.0}));
  EXPECT_EQ(it.body<TwistBody>().contacts(), 0);
}

/// A room of 6 m by 6 m.
World square_room() {
  World room = walls({{{-3.0, -3.0}, {3.0, -3.0}},
                      {{3.0, -3.0}, {3.0, 3.0}},
                      {{3.0, 3.0}, {-3.0, 3.0}},
                      {{-3.0, 3.0}, {-3.0, -3.0}}});
  room.bounds = {{-3.0, -3.0}, {3.0, 3.0}};
  return room;
}

TEST(SimulatedExplorer, PeopleKeepOffWallsAndTheRobot) {
  const World room = square_room();
  ExplorerSimParams params = faultless();
  params.faults.walk_ins.people = 4;
  SimulatedRobot it = simulated_explorer(room, {}, burger(), params, 1);
  const auto& walk_ins = it.body<TwistBody>().walk_ins();
  drive(it, {}, 0.1);
  ASSERT_EQ(walk_ins.disks().size(), 4u);
  double way_m = 0.0;
  for (int i = 0; i < 600; ++i) {
    const Vec2 before = walk_ins.disks().front().core.front();
    drive(it, {}, 0.1);
    way_m += distance(before, walk_ins.disks().front().core.front());
    for (const RoundedPolygon& disk : walk_ins.disks()) {
      const Vec2 at = disk.core.front();
      EXPECT_LE(std::max(std::abs(at.x), std::abs(at.y)), 3.0 - disk.radius_m + 1e-9);
      EXPECT_GE(distance(at, it.pose().position), burger().radius_m + disk.radius_m + 0.3 - 1e-9);
    }
  }
  EXPECT_GT(way_m, 20.0);
  EXPECT_EQ(it.body<TwistBody>().contacts(), 0);
}

TEST(SimulatedExplorer, SocialPeopleKeepApart) {
  ExplorerSimParams params = faultless();
  params.faults.walk_ins.people = 8;
  params.faults.walk_ins.people_social = true;
  SimulatedRobot it = simulated_explorer(square_room(), {}, burger(), params, 1);
  const auto& disks = it.body<TwistBody>().walk_ins().disks();
  double way_m = 0.0;
  int close = 0;
  constexpr int steps = 600;
  drive(it, {}, 0.1);
  ASSERT_EQ(disks.size(), 8u);
  for (int step = 0; step < steps; ++step) {
    const Vec2 before = disks.front().core.front();
    drive(it, {}, 0.1);
    way_m += distance(before, disks.front().core.front());
    for (const RoundedPolygon& disk : disks) {
      const Vec2 at = disk.core.front();
      EXPECT_LE(std::max(std::abs(at.x), std::abs(at.y)), 3.0 - disk.radius_m + 1e-9);
      EXPECT_GE(distance(at, it.pose().position), burger().radius_m + disk.radius_m + 0.3 - 1e-9);
      close += &disk != &disks.front() && distance(at, disks.front().core.front()) < 2.0 * disk.radius_m;
    }
  }
  EXPECT_GT(way_m, 20.0);
  EXPECT_LT(close, steps / 20) << "they push each other at times";
}

TEST(SimulatedExplorer, PostsGoAlongTheirPathsThereAndBack) {
  ExplorerSimParams params = faultless();
  params.laser.noise_m = 0.0;
  params.laser.most_m = 8.0;
  params.faults.walk_ins.posts = {{{{1.0, -2.0}, {1.0, 0.0}, {3.0, 0.0}}, 0.5, 0.4, 1.0}};
  SimulatedRobot it = simulated_explorer(square_room(), {{-2.0, 0.0}, 0.0}, burger(), params, 1);
  const auto& disks = it.body<TwistBody>().walk_ins().disks();
  drive(it, {}, 4.0);
  EXPECT_LT(distance(disks.front().core.front(), Vec2{2.0, 0.0}), 0.01);
  EXPECT_EQ(disks.front().radius_m, 0.4);
  const Observation seen = it.sense();
  EXPECT_NEAR(static_cast<double>(seen.scan->ranges_m.front()), 3.6, 0.02);
  drive(it, {}, 6.0);
  EXPECT_LT(distance(disks.front().core.front(), Vec2{1.0, 0.0}), 0.01);
}

/// Turns a long robot in place while a post comes along its side, or stands where its end comes by. Returns
/// the contacts, and how often it was walked into.
std::pair<std::int64_t, std::int64_t> turn_beside_post(double post_mps, Vec2 from) {
  ExplorerSimParams params = faultless();
  params.footprint = Footprint({{{-0.4, -0.1}, {0.4, -0.1}, {0.4, 0.1}, {-0.4, 0.1}}, 0.0});
  params.faults.walk_ins.posts = {{{from, {from.x, -2.0}}, post_mps, 0.2, 0.0}};
  SimulatedRobot it = simulated_explorer(square_room(), {{0.0, 0.0}, 0.0}, burger(), params, 1);
  drive(it, {0.0, 0.0, 0.3}, 2.0);
  return {it.body<TwistBody>().contacts(), it.body<TwistBody>().walked_into()};
}

TEST(SimulatedExplorer, WhoTurnsIsWalkedIntoByWhatComesFaster) {
  EXPECT_EQ(turn_beside_post(1.0, {0.1, 1.0}), std::pair(std::int64_t{0}, std::int64_t{1})) << "it came";
  EXPECT_EQ(turn_beside_post(1e-6, {0.35, 0.35}), std::pair(std::int64_t{1}, std::int64_t{0})) << "it stood";
}

/// Drives a robot with a footprint towards a post that comes at 1 m/s, and commands it to stand from a time
/// on. Returns the contacts, and how often it was walked into.
std::pair<std::int64_t, std::int64_t> meet_post(double speed_mps, double stands_from_s) {
  RobotModel robot = burger();
  robot.speed_mps = 2.0;
  robot.acceleration_mps2 = 2.0;
  ExplorerSimParams params = faultless();
  params.footprint = Footprint::disk(robot.radius_m);
  params.faults.walk_ins.posts = {{{{2.0, 0.0}, {-2.5, 0.0}}, 1.0, 0.2, 0.0}};
  SimulatedRobot it = simulated_explorer(square_room(), {{-1.0, 0.0}, 0.0}, robot, params, 1);
  drive(it, {speed_mps, 0.0, 0.0}, stands_from_s);
  drive(it, {}, 3.0 - stands_from_s);
  return {it.body<TwistBody>().contacts(), it.body<TwistBody>().walked_into()};
}

TEST(SimulatedExplorer, WhoBrakesIsWalkedIntoByWhatComesFaster) {
  EXPECT_EQ(meet_post(0.5, 3.0), std::pair(std::int64_t{1}, std::int64_t{0})) << "it drove";
  EXPECT_EQ(meet_post(0.0, 0.0), std::pair(std::int64_t{0}, std::int64_t{1})) << "it stood";
  EXPECT_EQ(meet_post(0.5, 1.75), std::pair(std::int64_t{0}, std::int64_t{1})) << "it braked";
  EXPECT_EQ(meet_post(2.0, 1.1), std::pair(std::int64_t{1}, std::int64_t{0})) << "it braked too late";
}

TEST(SimulatedExplorer, ItsClockJumps) {
  ExplorerSimParams params = faultless();
  params.faults.clock = {2.0, 30.0};
  SimulatedRobot it = simulated_explorer(walls({{{9.0, -2.0}, {9.0, 2.0}}}), {}, burger(), params, 1);
  it.act(DriveTwist{ahead, 1.9});
  EXPECT_NEAR(it.sense().time_s, 1.9, 1e-9);
  it.act(DriveTwist{ahead, 2.1});
  const Observation seen = it.sense();
  EXPECT_NEAR(seen.time_s, 32.1, 1e-9);
  ASSERT_TRUE(seen.scan);
  EXPECT_NEAR(seen.scan->time_s, 32.1, 1e-9);
  it.act(DriveTwist{ahead, 32.2});
  EXPECT_NEAR(it.time_s(), 2.2, 1e-9);
}

}  // namespace
}  // namespace outrider
