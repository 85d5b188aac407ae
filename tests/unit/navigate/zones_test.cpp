// Zones as planners and motions see them: nothing leads in, slow before and in them, and straight out.
#include "outrider/navigate/zones.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "outrider/core/rng.hpp"
#include "outrider/navigate/navigator.hpp"
#include "outrider/sim/simulated_robot.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

const Footprint box_body({{{-0.3, -0.15}, {0.2, -0.15}, {0.2, 0.15}, {-0.3, 0.15}}, 0.0});

Zone keep_out(std::vector<Vec2> corners) { return {.rings = {std::move(corners)}}; }
Zone slow(std::vector<Vec2> corners, double mps) {
  return {.kind = Zone::Kind::slow, .speed_mps = mps, .rings = {std::move(corners)}};
}
std::vector<Vec2> rectangle(Vec2 low, Vec2 high) { return {low, {high.x, low.y}, high, {low.x, high.y}}; }

TEST(Zones, CellsAndOverlapAgreeWithTheArea) {
  Rng rng(3);
  // A zone that is not convex, with a hole.
  const Zone zone{.rings = {{{-2, -2}, {2, -2}, {2, 2}, {0, 0}, {-2, 2}}, rectangle({-1, -1.5}, {1, -0.5})}};
  const Zones zones({zone}, 0.0);
  const GridFrame frame = covering({{-3, -3}, {3, 3}}, 0.05);
  const ZoneCells cells = zones.cells(frame, 0.5);
  ASSERT_EQ(cells.room_m.size(), frame.size());
  EXPECT_TRUE(cells.speed_mps.empty());
  for (int i = 0; i < 2000; ++i) {
    const Cell cell{static_cast<int>(rng.uniform(0, frame.width)),
                    static_cast<int>(rng.uniform(0, frame.height))};
    const Vec2 place = frame.centre(cell);
    if (std::abs(std::abs(place.x) - place.y) < 1e-6) continue;  // on a border
    const float room_m = cells.room_m[frame.index(cell)];
    EXPECT_EQ(room_m < 0.0F, zone.contains(place)) << place.x << ' ' << place.y;
    EXPECT_NEAR(std::max(room_m, 0.0F), std::min(0.5, zone.distance_to(place)), 0.005);
    const Footprint disk = Footprint::disk(0.2);
    EXPECT_EQ(zones.overlap(disk, {place, 1.0}), zone.distance_to(place) <= 0.2);
  }
}

TEST(Zones, TheRobotIsSlowInTime) {
  const Zones zones({slow(rectangle({5, -1}, {7, 1}), 0.3)}, 0.1);
  RobotModel robot;
  robot.speed_mps = 2.0;
  robot.acceleration_mps2 = 1.0;
  EXPECT_EQ(zones.most_mps({0, 0}, 0.3, robot, 0.05), 2.0);
  EXPECT_NEAR(zones.most_mps({6, 0}, 0.3, robot, 0.05), 0.3, 1e-9);
  EXPECT_NEAR(zones.most_mps({4.7, 0}, 0.3, robot, 0.05), 0.3, 1e-9);
  // It obeys what it is told with its full deceleration: from anywhere it is slow where it has to be.
  double x = 0.0, speed_mps = 2.0;
  while (x < 4.6) {
    const double told_mps = zones.most_mps({x, 0}, 0.3, robot, 0.05);
    const double next_mps = std::max(told_mps, speed_mps - robot.acceleration_mps2 * 0.05);
    EXPECT_NEAR(next_mps, std::min(told_mps, speed_mps), 1e-6) << x;
    x += 0.5 * (speed_mps + next_mps) * 0.05;
    speed_mps = next_mps;
  }
  EXPECT_NEAR(speed_mps, 0.3, 1e-6);
}

// ---- Ways ----------------------------------------------------------------------------------------

GoalField field_with(const Zones& zones, const std::vector<Vec2>& obstacles, Vec2 goal, int side = 0) {
  const GridFrame frame = covering({{-1, -4}, {9, 4}}, 0.05);
  const ZoneCells cells = zones.cells(frame, 0.6);
  RobotModel robot;
  robot.speed_mps = 1.0;
  GoalField field;
  GoalQuery query{goal};
  query.side = side;
  field.compute({frame, obstacles, nullptr, &cells}, Footprint::disk(0.2), robot, query, {});
  return field;
}

TEST(Zones, WaysLeadAroundAndTakeTheirTime) {
  const Zone across = keep_out(rectangle({3, -2}, {4, 4}));
  const GoalField around = field_with(Zones({across}, 0.1), {}, {8, 0});
  ASSERT_TRUE(around.time_s({0, 0}));
  for (const Vec2 place : around.way({0, 0}, 20.0)) EXPECT_GE(across.distance_to(place), 0.29);
  EXPECT_FALSE(around.time_s({3.5, 0.0}));  // nor is there a way from within
  const double plain_s = *field_with({}, {}, {8, 0}).time_s({0, 0});
  EXPECT_GT(*around.time_s({0, 0}), plain_s + 1.0);
  const Zones all_over({slow(rectangle({2, -4}, {5, 4}), 0.25)}, 0.1);
  EXPECT_NEAR(*field_with(all_over, {}, {8, 0}).time_s({0, 0}), plain_s + 3.0 / 0.25 - 3.0, 0.5);
}

TEST(Zones, APassageIsPassedOnThePreferredSide) {
  std::vector<Vec2> walls;
  for (double x = 0.0; x <= 8.0; x += 0.05) {
    for (const double y : {-1.2, 1.2}) walls.push_back({x, y});
  }
  const auto mean_y = [&](int side) {
    double sum = 0.0, count = 0.0;
    for (const Vec2 place : field_with({}, walls, {8, 0}, side).way({0, 0}, 20.0)) {
      if (place.x < 1.0 || place.x > 7.0) continue;
      sum += place.y;
      ++count;
    }
    return sum / count;
  };
  EXPECT_NEAR(mean_y(0), 0.0, 0.06);
  EXPECT_LT(mean_y(-1), -0.3);  // of a width of 2.4 m
  EXPECT_GT(mean_y(1), 0.3);
  EXPECT_GT(*field_with({}, walls, {8, 0}, -1).time_s({4, 0.5}),
            *field_with({}, walls, {8, 0}, 0).time_s({4, 0.5}));
}

// ---- Motions -------------------------------------------------------------------------------------

TEST(Zones, NoMotionEntersOne) {
  Rng rng(11);
  RobotModel robot;
  robot.speed_mps = 1.5;
  robot.acceleration_mps2 = 2.0;
  for (const LocalMotionRow& row : local_motions()) {
    for (int world = 0; world < testing::cases(3); ++world) {
      std::vector<Zone> all;
      for (int i = 0; i < 12; ++i) {
        const Vec2 at{rng.uniform(-1, 6), rng.uniform(-2.5, 2.5)};
        if (norm(at) > 1.4) all.push_back(keep_out({at, at + Vec2{0.6, 0.1}, at + Vec2{0.1, 0.7}}));
      }
      const Zones zones(all, 0.05);
      const LiveMap map({}, {});
      const ZoneCells cells = zones.cells(map.frame(), 0.8);
      GoalField field;
      field.compute({map.frame(), {}, nullptr, &cells}, box_body, robot, {{5, 0}}, Vec2{});
      const auto rule = row.make({});
      Pose2 pose;
      Twist2 twist;
      Surroundings near;
      for (double t = 0.0; t < 8.0; t += 0.05) {
        near.look(map, pose.position, 4.0, true, &zones, 0.03);
        near.find_distances();
        const Twist2 chosen = rule->choose({pose, twist, box_body, robot, near, field, {5, 0}});
        for (int i = 0; i < 10; ++i) {
          const Twist2 next = twist_after(twist, chosen, robot, 0.005);
          pose = moved_evenly(pose, twist, next, 0.005);
          twist = next;
          ASSERT_FALSE(zones.overlap(box_body, pose)) << row.name << ' ' << world << ' ' << t;
        }
      }
    }
  }
}

// ---- The navigator -------------------------------------------------------------------------------

NavigatorSetup setup_with(std::vector<Zone> zones) {
  NavigatorSetup setup;
  setup.robot.radius_m = 0.34;
  setup.robot.speed_mps = 1.0;
  setup.robot.acceleration_mps2 = 2.0;
  setup.robot.turn_rate_radps = 2.0;
  setup.footprint = box_body;
  setup.options.localiser = "odometry";
  setup.zones = std::move(zones);
  return setup;
}

SimulatedRobot simulated(const World& world, const NavigatorSetup& setup) {
  ExplorerSimParams params;
  params.laser.rate_hz = 20.0;
  params.footprint = setup.footprint;
  params.wheels = {};
  params.wheels.scale_error = params.wheels.noise_m = 0.0;
  return simulated_explorer(world, {}, setup.robot, params, 1);
}

World hall() {
  World world;
  for (const auto& [middle, size] :
       {std::pair{Vec2{3, 3}, Vec2{12, 0.2}}, {{3, -3}, {12, 0.2}}, {{-3, 0}, {0.2, 6}}, {{9, 0}, {0.2, 6}}})
    world.solids.push_back(
        {"wall", {{middle.x, middle.y, 0.5}, {}}, BoxShape{{0.5 * size.x, 0.5 * size.y, 0.5}}});
  return world;
}

TEST(Zones, ARobotThatWasCarriedIntoOneLeavesByTheShortestWay) {
  // It stands 0.7 m from the right side of the zone and farther from all others, and looks along it.
  const Zone zone = keep_out(rectangle({-2.0, -0.7}, {4.0, 2.0}));
  const NavigatorSetup setup = setup_with({zone});
  SimulatedRobot robot = simulated(hall(), setup);
  auto navigator = Navigator::make(setup, Pose2{});
  double driven_m = 0.0, out_s = 0.0;
  bool arrived = false;
  while (robot.time_s() < 60.0 && !arrived) {
    const Situation now = navigator->perceive(robot.sense());
    ASSERT_NE(now.progress.state, Progress::State::blocked) << now.progress.why;
    arrived = now.progress.state == Progress::State::arrived;
    robot.act(navigator->act(GoTo{{6.0, 0.5}, 0.15}));
    const bool inside = Zones({zone}, 0.0).overlap(box_body, robot.pose());
    if (inside) {
      EXPECT_EQ(out_s, 0.0) << "it went in again";
      driven_m = robot.body<TwistBody>().driven_m();
      EXPECT_LT(std::abs(robot.pose().position.x), 0.2);
    } else if (out_s == 0.0) {
      out_s = robot.time_s();
    }
  }
  EXPECT_TRUE(arrived);
  EXPECT_LT(driven_m, 1.1);  // 0.7 m and the robot
  EXPECT_GT(driven_m, 0.7);
}

TEST(Zones, ARobotThatCannotLeaveOneSaysSo) {
  const NavigatorSetup setup = setup_with({keep_out(rectangle({-30, -30}, {30, 30}))});
  SimulatedRobot robot = simulated(hall(), setup);
  auto navigator = Navigator::make(setup, Pose2{});
  Progress progress;
  while (robot.time_s() < 30.0 && progress.state == Progress::State::underway) {
    progress = navigator->perceive(robot.sense()).progress;
    robot.act(navigator->act(GoTo{{6.0, 0.5}, 0.15}));
  }
  EXPECT_EQ(progress.state, Progress::State::blocked);
  EXPECT_NE(progress.why.find("keep-out zone"), std::string::npos) << progress.why;
  EXPECT_EQ(robot.body<TwistBody>().driven_m(), 0.0);
}

TEST(Zones, ARobotWhoseWheelsDoNotTurnSaysThatItCannotLeaveOne) {
  const NavigatorSetup setup = setup_with({keep_out(rectangle({-2.0, -0.7}, {4.0, 2.0}))});
  SimulatedRobot robot = simulated(hall(), setup);
  auto navigator = Navigator::make(setup, Pose2{});
  Progress progress;
  bool tried = false;
  while (robot.time_s() < 30.0 && progress.state == Progress::State::underway) {
    progress = navigator->perceive(robot.sense()).progress;
    const Command command = navigator->act(GoTo{{6.0, 0.5}, 0.15});
    tried = tried || !(std::get<DriveTwist>(command).twist == Twist2{});
    robot.act(DriveTwist{{}, robot.time_s() + setup.options.period_s});
  }
  EXPECT_TRUE(tried);
  EXPECT_EQ(progress.state, Progress::State::blocked);
  EXPECT_NE(progress.why.find("keep-out zone"), std::string::npos) << progress.why;
}

TEST(Zones, NoRecoveryLeadsIntoOne) {
  // The only way leads through a zone, so it recovers in all ways before it gives up.
  const Zone zone = keep_out({{1.0, -3.0}, {2.0, -3.0}, {2.0, 3.0}, {1.2, 3.0}, {1.0, 0.5}});
  const Zone behind = keep_out(rectangle({-1.5, -3.0}, {-0.5, 3.0}));
  NavigatorSetup setup = setup_with({zone, behind});
  setup.options.most_recoveries = 6;
  SimulatedRobot robot = simulated(hall(), setup);
  auto navigator = Navigator::make(setup, Pose2{});
  Progress progress;
  while (robot.time_s() < 90.0 && progress.state == Progress::State::underway) {
    progress = navigator->perceive(robot.sense()).progress;
    robot.act(navigator->act(GoTo{{6.0, 0.5}, 0.15}));
    ASSERT_FALSE(Zones({zone, behind}, 0.0).overlap(box_body, robot.pose())) << robot.time_s();
  }
  EXPECT_EQ(progress.state, Progress::State::blocked);
}

}  // namespace
}  // namespace outrider
