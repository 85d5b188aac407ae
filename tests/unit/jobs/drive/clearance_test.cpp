// The clearance that drives keep along the paths of all planners.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "outrider/control/rounded_path.hpp"
#include "outrider/core/units.hpp"
#include "outrider/jobs/drive/run.hpp"
#include "outrider/jobs/drive/scenario.hpp"
#include "outrider/path/catalog.hpp"
#include "room.hpp"
#include "support/costly_cases.hpp"
#include "support/drive_faults.hpp"

namespace outrider {
namespace {

DriveScenario arena(const std::string& planner) {
  DriveScenario scenario;
  scenario.world = OUTRIDER_SOURCE_DIR "/scenarios/arena/arena.sdf";
  scenario.start = "2.5,0.5,90";
  scenario.goal = "1,2.5,180";
  scenario.tags =
      "0=1,0,90 1=2,0,90 2=3,1,180 3=3,2,180 4=2,3,-90 5=1,3,-90 6=0,2,0 7=0,1,0 8=1.5,1.325,-90 "
      "9=1.725,1.5,0 "
      "10=1.5,1.675,90 11=1.275,1.5,180";
  scenario.sight = "modelled";
  scenario.planner = planner;
  return scenario;
}

/// Returns the places of the start and of all waypoints.
std::vector<Vec2> way_of(const DriveTask& task) {
  std::vector<Vec2> points = {task.start.position};
  for (const Waypoint& waypoint : task.waypoints) points.push_back(waypoint.pose.position);
  return points;
}

/// Returns how much more clearance than the robot's radius the legs between the driven waypoints keep.
double leg_margin_m(const DriveTask& task) {
  return way_clearance_m(way_of(task), CollisionMap::of(task.world, task.eye.height_m)) - task.radius_m;
}

/// Around the box the legs have 3 to 5 cm beyond the robot's radius; 2 cm are errors of the belief and the
/// wheels.
TEST(DriveClearance, NoFollowerTouchesAnythingOnThePathOfAnyPlanner) {
  constexpr double kept = 0.6, errors_m = 0.02;
  std::vector<std::vector<Vec2>> driven;  // planners that find the same path are driven once
  for (const PathPlanner& planner : path_planners()) {
    if (planner.steers) continue;
    for (const char* chassis : {"mecanum", "differential"}) {
      DriveScenario scenario = arena(std::string(planner.name));
      scenario.chassis = chassis;
      if (scenario.chassis == "differential") scenario.task.follow.mode = "rotate_then_go";
      const auto setup = load_drive(scenario);
      ASSERT_TRUE(setup) << planner.name << ": " << to_string(setup.error());
      std::vector<Vec2> way = way_of(setup->task);
      if (scenario.chassis == "mecanum" && std::ranges::find(driven, way) != driven.end()) break;
      driven.push_back(std::move(way));
      const double legs_m = leg_margin_m(setup->task);
      for (const char* follower : {"pid", "pure_pursuit", "time_optimal"}) {
        DriveTask task = setup->task;
        task.follow.follower = follower;
        for (int seed = 1; seed <= testing::costly_cases(1); ++seed) {
          Log log;
          const Report report =
              run_drive(task, testing::usual_faults(), false, static_cast<std::uint64_t>(seed), log);
          const std::string name =
              std::string(planner.name) + ' ' + chassis + ' ' + follower + ' ' + std::to_string(seed);
          EXPECT_EQ(report.status, "done") << name << ": " << report.reason;
          const double margin_m = metric(report, "clearance_m") - task.radius_m;
          EXPECT_GT(margin_m, 0.0) << name;
          EXPECT_GE(margin_m, std::min(kept * legs_m, legs_m - errors_m)) << name << ' ' << legs_m;
        }
      }
    }
  }
}

/// A wheel that hardly turns takes the robot off its way, towards the box.
TEST(DriveClearance, ARobotThatDoesNotMoveAsCommandedStopsBeforeItTouches) {
  const auto setup = load_drive(arena("visibility_graph"));
  ASSERT_TRUE(setup) << to_string(setup.error());
  DriveSimParams params = testing::usual_faults();
  params.wheels.gains[0] = 0.1;
  for (int seed = 1; seed <= testing::costly_cases(4); ++seed) {
    Log log;
    const Report report = run_drive(setup->task, params, false, static_cast<std::uint64_t>(seed), log);
    EXPECT_EQ(report.status, "not_done");
    EXPECT_NE(report.reason.find("does not move as it is commanded"), std::string::npos) << report.reason;
    EXPECT_GE(metric(report, "clearance_m"), setup->task.radius_m) << seed;
  }
}

/// Against dense samples of the corner, cut by the room and by a little more.
TEST(DriveClearance, TheRoomKeepsTheClearanceOfTheLegs) {
  Rng rng(1);
  for (int round = 0; round < 50; ++round) {
    DriveTask task;
    task.radius_m = 0.15;
    const Vec2 at{1.5, 1.5};
    const Vec2 before = at + rng.uniform(0.4, 1.0) * direction(rng.uniform(-pi, pi));
    const Vec2 after = at + rng.uniform(0.4, 1.0) * direction(rng.uniform(-pi, pi));
    const Vec2 post = at + rng.uniform(0.2, 0.5) * direction(rng.uniform(-pi, pi));
    const CollisionMap ground{{{0, 0}, {3, 3}}, {{{post}, 0.02}}};
    task.start = {before, 0.0};
    task.waypoints = {{{at, 0.0}, false}, {{after, 0.0}}};
    const double legs_m = way_clearance_m({before, at, after}, ground) - task.radius_m;
    if (legs_m < 0.01) continue;
    set_rooms(task, ground);
    const double room_m = task.waypoints[0].room_m;
    EXPECT_LE(room_m, task.follow.pass_m);
    const auto clearance = [&](double room) {
      return way_clearance_m(rounded_corner(before, at, after, room, 1.0, 1.0), ground) - task.radius_m;
    };
    EXPECT_GE(clearance(room_m), 0.9 * std::min(legs_m, 0.5) - 2e-4) << "to the step of a bisection";
    // More is not allowed, or the legs are too short for it.
    const double more_m = 1.05 * room_m + 1e-4;
    if (more_m < task.follow.pass_m && clearance(more_m) >= 0.9 * legs_m + 2e-4) {
      EXPECT_NEAR(clearance(more_m), clearance(room_m), 1e-9);
    }
  }
}

}  // namespace
}  // namespace outrider
