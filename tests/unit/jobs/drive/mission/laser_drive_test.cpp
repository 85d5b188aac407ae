// Drives by laser: around what stands there, true claims, reasons.
#include "outrider/jobs/drive/mission/laser_drive.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "laser_hall.hpp"
#include "outrider/jobs/drive/job.hpp"
#include "outrider/log/messages/scene_messages.hpp"
#include "outrider/log/topics.hpp"
#include "support/random_cases.hpp"
#include "support/run_bytes.hpp"

namespace outrider {
namespace {

using namespace laser_drive;

TEST(LaserDrive, GoesAroundWhatStandsInTheWay) {
  for (int seed = 1; seed <= testing::cases(2); ++seed) {
    Log log;
    const Report report = driven(hall(), options(), log, static_cast<std::uint64_t>(seed));
    EXPECT_EQ(report.status, "done") << report.reason;
    EXPECT_EQ(metric(report, "contacts"), 0.0);
    EXPECT_EQ(metric(report, "false_arrivals"), 0.0);
    EXPECT_LT(metric(report, "time_s"), 60.0);
    const Table& waypoints = table_named(report, "waypoints");
    ASSERT_EQ(waypoints.rows.size(), 3U);
    for (const auto& row : waypoints.rows)
      EXPECT_LT(std::hypot(TableRow{waypoints, row}.number("dx"), TableRow{waypoints, row}.number("dy")),
                0.3);
    EXPECT_NE(log.latest<nav_msgs::OccupancyGrid>(topic::map), nullptr);
  }
}

TEST(LaserDrive, SaysWhatItCouldNotReach) {
  DriveTask task = hall();
  task.world.solids.push_back(crate({3.5, 0}, {0.2, 6}));  // a wall from side to side
  task.waypoints = {{{{5.5, 0}, 0.0}}};
  LaserDriveOptions how = options();
  how.navigator.most_recoveries = 3;
  Log log;
  const Report report = driven(task, how, log);
  EXPECT_EQ(report.status, "not_done");
  EXPECT_NE(report.reason.find("waypoint 1 was not reached: no way to (5.50, 0.00)"), std::string::npos)
      << report.reason;
  EXPECT_EQ(metric(report, "contacts"), 0.0);
}

TEST(LaserDrive, ACarStopsWithItsHeadings) {
  LaserDriveOptions how = options();
  how.turning_radius_m = 0.5;
  how.footprint = "-0.35,-0.2 0.45,-0.2 0.45,0.2 -0.35,0.2";
  Log log;
  const Report report = driven(hall(), how, log);
  EXPECT_EQ(report.status, "done") << report.reason;
  EXPECT_EQ(metric(report, "contacts"), 0.0);
  EXPECT_EQ(metric(report, "false_arrivals"), 0.0);
  const auto* outline = log.latest<geometry_msgs::PolygonStamped>(topic::footprint);
  ASSERT_NE(outline, nullptr);
  ASSERT_EQ(outline->polygon.points.size(), 4U);
  EXPECT_EQ(outline->polygon.points[1].x, 0.45F);
  EXPECT_NEAR(log.latest<outrider_msgs::RunInfo>(topic::run)->robot_radius, 0.2, 1e-12);
}

TEST(LaserDrive, ACarSaysThatItsRadiusIsTooLarge) {
  DriveTask task = hall();
  task.waypoints = {{{{4, 1.5}, pi}}};
  LaserDriveOptions how = options();
  how.turning_radius_m = 60.0;
  how.navigator.most_recoveries = 2;
  Log log;
  const Report report = driven(task, how, log);
  EXPECT_EQ(report.status, "not_done");
  EXPECT_NE(report.reason.find("was found with a turning radius of 60 m"), std::string::npos)
      << report.reason;
  EXPECT_EQ(metric(report, "contacts"), 0.0);
}

TEST(LaserDrive, DoesNotClaimPlacesWhereItIsNot) {
  LaserDriveOptions how = options();
  how.navigator.localiser = "odometry";
  how.wheels.scale_error = 0.1;
  int off = 0;
  for (int seed = 1; seed <= testing::cases(1); ++seed) {
    Log log;
    const Report report = driven(hall(), how, log, static_cast<std::uint64_t>(seed));
    if (metric(report, "false_arrivals") > 0.0) {
      ++off;
      EXPECT_EQ(report.status, "not_done");
    }
  }
  EXPECT_GT(off, 0);
}

TEST(LaserDriveByTags, GoesAroundWhatStandsThereAndIsLocalisedByTags) {
  DriveTask task = hall();
  task.waypoints = {{{{5.5, 1.5}, 1.5}}, {{{-1.0, 0.0}, 3.0}}};
  task.tags.tags = {
      upright_tag(1, {6.85, 0.5, 0.25}, pi),        upright_tag(2, {5.0, 2.85, 0.25}, -0.5 * pi),
      upright_tag(3, {-2.85, 0.0, 0.25}, 0.0),      upright_tag(4, {0.0, 2.85, 0.25}, -0.5 * pi),
      upright_tag(5, {5.0, -2.85, 0.25}, 0.5 * pi), upright_tag(6, {0.0, -2.85, 0.25}, 0.5 * pi)};
  LaserDriveOptions how = options();
  how.rendered = false;
  how.wheels.scale_error = 0.05;
  for (int seed = 1; seed <= testing::cases(1); ++seed) {
    Log log, believed;
    how.navigator.localiser = "tags";
    const Report report = driven(task, how, log, static_cast<std::uint64_t>(seed));
    EXPECT_EQ(report.status, "done") << report.reason;
    EXPECT_EQ(metric(report, "contacts"), 0.0);
    how.navigator.localiser = "odometry";
    const Report without = driven(task, how, believed, static_cast<std::uint64_t>(seed));
    EXPECT_LT(metric(report, "belief_error_m"), 0.5 * metric(without, "belief_error_m"));
  }
}

TEST(LaserDrive, GivesTheSameBytesAgain) {
  const auto bytes = [] {
    Log log;
    const Report report = driven(hall(), options(), log);
    return test::bytes_of_log(log) + fmt::format("{}", metric(report, "time_s"));
  };
  EXPECT_EQ(bytes(), bytes());
}

TEST(LaserDrive, IsAskedForByItsLoop) {
  DriveJob job;
  job.scenario.loop = "laser";
  job.scenario.bounds = "-5,-5,5,5";
  job.scenario.waypoints = "1,0,0";
  job.scenario.laser.footprint = "0.1,0.1 0.2,0.2";
  const auto bad = job.load();
  ASSERT_FALSE(bad);
  EXPECT_EQ(bad.error().where, "navigator.footprint");
  job.scenario.laser.footprint = "0.2";
  job.scenario.planner = "visibility_graph";
  job.scenario.goal = "1,0,0";
  job.scenario.waypoints.clear();
  const auto planned = job.load();
  ASSERT_FALSE(planned);
  EXPECT_EQ(planned.error().where, "planner");
  job.given = {"faults.wheel_1"};
  const auto faulty = job.load();
  ASSERT_FALSE(faulty);
  EXPECT_EQ(faulty.error().where, "faults.wheel_1");
}

}  // namespace
}  // namespace outrider
