#include "outrider/jobs/explore/mission/mission.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace outrider {
namespace {

constexpr float no_number = std::numeric_limits<float>::quiet_NaN();

/// A robot without mass or errors among boxes, ray by ray and box by box.
struct RobotAmongBoxes {
  std::vector<Box2> boxes;
  Pose2 pose;
  double time_s = 0.0;
  int scans = 0;
  bool held = false;  ///< it does not move
  int touches = 0;    ///< of the bumper that are still to come
  double range_m = 3.5;

  [[nodiscard]] double range(double bearing_rad) const {
    const Vec2 along = direction(pose.heading_rad + bearing_rad);
    double nearest = std::numeric_limits<double>::infinity();
    for (const Box2& box : boxes) {
      const double x0 = (box.low.x - pose.position.x) / along.x,
                   x1 = (box.high.x - pose.position.x) / along.x;
      const double y0 = (box.low.y - pose.position.y) / along.y,
                   y1 = (box.high.y - pose.position.y) / along.y;
      const double enters = std::max(std::min(x0, x1), std::min(y0, y1));
      if (enters > 0.0 && enters < std::min(std::max(x0, x1), std::max(y0, y1)))
        nearest = std::min(nearest, enters);
    }
    return nearest;
  }

  [[nodiscard]] double gap(double radius_m) const {
    double least = std::numeric_limits<double>::infinity();
    for (const Box2& box : boxes) {
      const Vec2 p = pose.position;
      least = std::min(least, distance(p, Vec2{std::clamp(p.x, box.low.x, box.high.x),
                                               std::clamp(p.y, box.low.y, box.high.y)}));
    }
    return least - radius_m;
  }

  Observation sense() {
    Observation seen{.time_s = time_s, .odometry = pose};
    if (touches > 0 && time_s > 5.0) seen.touching = touches-- > 0;
    if (time_s < 0.2 * scans - 1e-9) return seen;
    LaserScan scan{time_s, 0.0, 2.0 * pi / 360.0, 0.12, range_m, {}};
    for (int i = 0; i < 360; ++i) {
      const double r = range(i * scan.step_rad);
      scan.ranges_m.push_back(r > range_m ? std::numeric_limits<float>::infinity() : static_cast<float>(r));
    }
    seen.scan = std::move(scan);
    ++scans;
    return seen;
  }

  void act(const DriveTwist& command) {
    if (!held) pose = moved(pose, command.twist, command.until_s - time_s);
    time_s = command.until_s;
  }
};

/// Two rooms of 2 m x 2 m with a door of 0.6 m, the robot in the west one.
RobotAmongBoxes in_two_rooms() {
  return {{{{-1.1, -1.1}, {3.1, -1.0}},
           {{-1.1, 1.0}, {3.1, 1.1}},
           {{-1.1, -1.1}, {-1.0, 1.1}},
           {{3.0, -1.1}, {3.1, 1.1}},
           {{0.95, -1.0}, {1.05, 0.3}},
           {{0.95, 0.9}, {1.05, 1.0}}},
          {{-0.5, -0.5}, 0.3}};
}

ExploreTask task_of(const RobotAmongBoxes& robot) {
  ExploreTask task;
  task.start = robot.pose;
  task.slam.trust_odometry = true;
  return task;
}

struct Told {
  ExploreMission mission;
  std::vector<DriveTwist> commands;
  double least_gap_m = 10.0;
};

/// Runs to the end; `spoil` may change what is seen.
template <class Spoil>
Told explore(RobotAmongBoxes robot, const ExploreTask& task, Spoil spoil) {
  robot.pose = task.start;
  const Pose2 start = robot.pose;
  Told told{*begin(task), {}};
  while (told.commands.size() < 20000) {
    Observation seen = robot.sense();
    seen.odometry = relative_pose(start, seen.odometry);
    spoil(seen, robot);
    const auto command = told.mission.step(seen);
    if (!command) break;
    told.commands.push_back(std::get<DriveTwist>(*command));
    robot.act(told.commands.back());
    told.least_gap_m = std::min(told.least_gap_m, robot.gap(task.robot.radius_m));
  }
  EXPECT_EQ(told.mission.stage(), ExploreStage::over);
  return told;
}
Told explore(const RobotAmongBoxes& robot, const ExploreTask& task) {
  return explore(robot, task, [](Observation&, RobotAmongBoxes&) {});
}

/// Free cells of the map, of all that the two rooms and their door have.
double mapped(const Told& told) {
  const auto& map = told.mission.where().slam().map().occupancy();
  double free = 0.0, all = 0.0;
  for (double x = -0.9; x < 2.95; x += 0.05) {
    for (double y = -0.9; y < 0.95; y += 0.05) {
      if (std::abs(x - 1.0) < 0.12) continue;
      const Cell cell = map.frame.cell_at({x, y});
      all += 1.0;
      free += map.contains(cell) && map[cell] == free_cell ? 1.0 : 0.0;
    }
  }
  return free / all;
}

TEST(ExploreMission, MapsTwoRoomsAndComesHome) {
  const auto robot = in_two_rooms();
  const Told told = explore(robot, task_of(robot));
  EXPECT_EQ(told.mission.stop_reason(), "complete");
  EXPECT_TRUE(told.mission.is_home());
  EXPECT_GT(mapped(told), 0.99);
  EXPECT_GT(told.least_gap_m, 0.0);
  EXPECT_GT(told.mission.decisions(), 1);
  EXPECT_EQ(told.mission.stuck(), 0);
  EXPECT_LT(told.mission.where().time_s(), 60.0);
}

TEST(ExploreMission, SaysTheSameTwice) {
  const auto robot = in_two_rooms();
  const Told one = explore(robot, task_of(robot)), two = explore(robot, task_of(robot));
  ASSERT_EQ(one.commands.size(), two.commands.size());
  for (std::size_t i = 0; i < one.commands.size(); ++i) {
    EXPECT_EQ(one.commands[i].twist, two.commands[i].twist);
    EXPECT_EQ(one.commands[i].until_s, two.commands[i].until_s);
  }
}

TEST(ExploreMission, ABadScanNeverEndsIt) {
  const auto robot = in_two_rooms();
  const Told told = explore(robot, task_of(robot), [](Observation& seen, RobotAmongBoxes& sim) {
    if (!seen.scan || sim.scans % 3 != 0) return;
    LaserScan& scan = *seen.scan;
    switch (sim.scans / 3 % 5) {
      case 0: scan.ranges_m.assign(360, no_number); break;
      case 1: scan.ranges_m.clear(); break;
      case 2: scan.step_rad = 0.0; break;
      case 3: scan.most_m = -1.0; break;
      default: scan.first_rad = std::numeric_limits<double>::infinity();
    }
  });
  EXPECT_EQ(told.mission.stop_reason(), "complete");
  EXPECT_TRUE(told.mission.is_home());
  EXPECT_GT(told.mission.where().bad_scans(), 10);
  EXPECT_GT(mapped(told), 0.99);
}

TEST(ExploreMission, OdometryThatIsNoNumberIsLeftOut) {
  const auto robot = in_two_rooms();
  int count = 0;
  const Told told = explore(robot, task_of(robot), [&](Observation& seen, RobotAmongBoxes&) {
    if (++count % 7 == 0) seen.odometry.position.x = std::numeric_limits<double>::quiet_NaN();
    if (count % 7 == 0) seen.scan.reset();
  });
  EXPECT_TRUE(std::isfinite(told.mission.where().pose().position.x));
  EXPECT_EQ(told.mission.stop_reason(), "complete");
}

TEST(ExploreMission, StandsStillAndEndsWithoutScans) {
  const auto robot = in_two_rooms();
  const ExploreTask task = task_of(robot);
  const Told told = explore(robot, task, [](Observation& seen, RobotAmongBoxes& sim) {
    if (sim.time_s > 2.0) seen.scan.reset();
  });
  EXPECT_EQ(told.mission.stop_reason(), "blind");
  EXPECT_EQ(told.commands.back().twist, Twist2{});
  EXPECT_LT(told.mission.where().time_s(), 2.0 + 11.0 * task.rules.blind_s);
  const Told never = explore(robot, task, [](Observation& seen, RobotAmongBoxes&) { seen.scan.reset(); });
  EXPECT_EQ(never.mission.stop_reason(), "blind");
}

TEST(ExploreMission, GoesHomeWhenTheBudgetIsSpent) {
  const auto robot = in_two_rooms();
  ExploreTask task = task_of(robot);
  task.rules.most_distance_m = 0.8;
  const Told told = explore(robot, task);
  EXPECT_EQ(told.mission.stop_reason(), "budget");
  EXPECT_TRUE(told.mission.is_home());
  EXPECT_LT(told.mission.where().driven_m(), 2.0);
}

TEST(ExploreMission, StaysWhereItEndsWhenItNeedNotReturn) {
  const auto robot = in_two_rooms();
  ExploreTask task = task_of(robot);
  task.rules.return_home = false;
  const Told told = explore(robot, task);
  EXPECT_EQ(told.mission.stop_reason(), "complete");
  EXPECT_FALSE(told.mission.is_home());
}

TEST(ExploreMission, ARobotThatCannotMoveGivesUp) {
  auto robot = in_two_rooms();
  robot.held = true;
  ExploreTask task = task_of(robot);
  task.rules.most_stuck = 3;
  const Told told = explore(robot, task);
  EXPECT_EQ(told.mission.stop_reason(), "left_over");
  ASSERT_FALSE(told.mission.left().places.empty());
  EXPECT_EQ(told.mission.left().places[0].reason, LeftReason::failed);
  EXPECT_GE(told.mission.stuck(), 3) << "each goal is tried again";
  EXPECT_LT(told.mission.where().time_s(), 200.0);
}

TEST(ExploreMission, GoesBackALittleFromWhatItTouches) {
  auto robot = in_two_rooms();
  robot.touches = 1;
  const Told told = explore(robot, task_of(robot));
  EXPECT_EQ(told.mission.stop_reason(), "complete");
  EXPECT_EQ(told.mission.stuck(), 1);
  EXPECT_TRUE(
      std::ranges::any_of(told.commands, [](const DriveTwist& c) { return c.twist.ahead_mps < 0.0; }));
  EXPECT_EQ(std::ranges::count(told.mission.events(), std::string("touch"), &ExploreEvent::kind), 1);
}

TEST(ExploreMission, NoticesAWorldThatLeaks) {
  RobotAmongBoxes robot{{{{2.0, -1.0}, {2.1, 1.0}}}, {{0.0, 0.0}, 0.0}};
  ExploreTask task = task_of(robot);
  task.explore.most_extent_m = 6.0;
  const Told told = explore(robot, task);
  EXPECT_EQ(told.mission.stop_reason(), "leak");
  EXPECT_TRUE(told.mission.is_home());
}

TEST(ExploreMission, RefusesNamesThatThereAreNot) {
  ExploreTask task;
  task.explore.strategy = "turo";
  const auto refused = begin(task);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().sentence.find("did you mean 'tour'"), std::string::npos)
      << refused.error().sentence;
  task = {};
  task.explore.planner = "none";
  EXPECT_FALSE(begin(task));
}

}  // namespace
}  // namespace outrider
