// The log of an exploration holds what its SLAM was fed, exactly: mapping the log, in each format, gives the
// map of a SLAM that is fed with the same scans and odometry as values.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "outrider/io/files/files.hpp"
#include "outrider/io/map/map_server.hpp"
#include "outrider/job/run_job.hpp"
#include "outrider/jobs/catalog.hpp"
#include "outrider/jobs/explore/job.hpp"
#include "outrider/jobs/explore/run.hpp"
#include "outrider/jobs/slam/scenario.hpp"
#include "outrider/log/mcap/mcap_sink.hpp"
#include "outrider/log/messages/conversions.hpp"
#include "outrider/log/messages/ros_sensor_messages.hpp"
#include "outrider/log/topics.hpp"
#include "outrider/slam/laser/laser_slam.hpp"
#include "outrider/world/known_extent.hpp"
#include "support/robot_logs.hpp"

namespace outrider {
namespace {

/// The measurements of an explorer when it had a scan.
struct Measured {
  LaserScan scan;
  Pose2 odometry;
};

/// The office, explored for 90 s: what was measured, and the log.
struct Exploration {
  Log log;
  std::vector<Measured> measured;
  Pose2 robot_T_laser;
};

const Exploration& office() {
  static const Exploration made = [] {
    ExploreJob task;
    const auto read = read_scenario(task, OUTRIDER_SOURCE_DIR "/scenarios/explore/office.yaml");
    if (!read || !task.load()) throw std::runtime_error("the scenario cannot be read");
    ExploreSetup& setup = *task.setup;
    setup.task.rules.most_time_s = 90.0;
    setup.task.rules.return_home = false;
    Exploration office;
    office.robot_T_laser = setup.sim.laser.robot_T_laser;
    const auto run = run_explore(setup.world, setup.task, setup.sim, 1, office.log, {},
                                 [&](const Observation& seen, const ExploreMission&, const SimulatedRobot&) {
                                   office.measured.push_back({*seen.scan, seen.odometry});
                                 });
    if (!run) throw std::runtime_error(run.error().sentence);
    return office;
  }();
  return made;
}

/// Returns the map of SLAM that is fed with the measurements, as an image of its known part.
std::string map_of(const Exploration& office) {
  LaserSlamOptions options = SlamScenario{}.laser;
  options.robot_T_laser = office.robot_T_laser;
  auto slam = LaserSlam::begin(options, {});
  Pose2 before = office.measured.front().odometry;
  for (const auto& [scan, odometry] : office.measured) {
    if (!slam->advance(wrap_heading(relative_pose(before, odometry)), scan)) return {};
    before = odometry;
  }
  slam->settle();
  const Grid<std::uint8_t>& whole = slam->map().occupancy();
  const CellExtent known = known_extent(whole);
  Grid<std::uint8_t> part(
      {whole.frame.corner(known.low), whole.frame.resolution_m, known.width(), known.height()}, unknown_cell);
  for (int y = known.low.y; y <= known.high.y; ++y) {
    for (int x = known.low.x; x <= known.high.x; ++x)
      part[{x - known.low.x, y - known.low.y}] = whole[{x, y}];
  }
  return map_server_text({part, 0.0}, "map.pgm")->image;
}

/// Returns the map that the job slam makes of a log.
std::string map_of_log(const std::string& bytes, const std::string& name) {
  const auto path = std::filesystem::temp_directory_path() / ("outrider_exact_log_" + name);
  if (!write_file(path.string(), bytes)) return "not written";
  const Job job = *find_job(jobs(), "slam");
  const auto task = job.blank();
  const auto changed = change(*task, {{"log", path.string()}});
  const auto run = run_task(job, *task);
  std::filesystem::remove(path);
  if (!changed || !run) return "not mapped";
  const auto map = std::ranges::find(run->files, "map.pgm", &NamedContent::path);
  return map == run->files.end() ? "no map" : map->content;
}

TEST(ExactLog, HoldsTheScansAndTheOdometryThatWereMeasured) {
  const auto& [log, measured, robot_T_laser] = office();
  const auto& scans = log.messages<sensor_msgs::LaserScan>(topic::scan);
  const auto& odometry = log.messages<nav_msgs::Odometry>(topic::odometry);
  ASSERT_EQ(scans.size(), measured.size());
  ASSERT_EQ(odometry.size(), measured.size());
  std::size_t without_return = 0;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const LaserScan& scan = measured[i].scan;
    const sensor_msgs::LaserScan& logged = scans[i].message;
    ASSERT_EQ(scans[i].time_s(), scan.time_s);
    ASSERT_EQ(seconds(nanoseconds_of(logged.header.stamp)), scan.time_s);
    ASSERT_EQ(static_cast<double>(logged.angle_increment), scan.step_rad);
    ASSERT_EQ(static_cast<double>(logged.range_min), scan.least_m);
    ASSERT_EQ(static_cast<double>(logged.range_max), scan.most_m);
    ASSERT_EQ(logged.ranges, scan.ranges_m);
    for (const float range_m : logged.ranges) {
      ASSERT_TRUE(std::isinf(range_m) || range_m <= logged.range_max) << range_m;
      without_return += std::isinf(range_m) ? 1U : 0U;
    }
    ASSERT_EQ(pose_of(odometry[i].message.pose.pose), measured[i].odometry);
  }
  EXPECT_GT(without_return, 0U);
}

TEST(ExactLog, IsMappedAsWhatWasMeasuredInEachFormat) {
  const Exploration& explored = office();
  const std::string map = map_of(explored);
  ASSERT_GT(map.size(), 1000U);

  test::RobotMessages messages;
  for (const auto& one : explored.log.messages<tf2_msgs::TFMessage>(topic::static_transforms))
    messages.add(std::string(topic::static_transforms), one.time_s(), one.message);
  const auto& scans = explored.log.messages<sensor_msgs::LaserScan>(topic::scan);
  const auto& odometry = explored.log.messages<nav_msgs::Odometry>(topic::odometry);
  for (std::size_t i = 0; i < scans.size(); ++i) {
    messages.add(std::string(topic::scan), scans[i].time_s(), scans[i].message);
    messages.add(std::string(topic::odometry), odometry[i].time_s(), odometry[i].message);
  }
  EXPECT_TRUE(map_of_log(messages.mcap(), "run.mcap") == map);
  EXPECT_TRUE(map_of_log(messages.db3(), "run.db3") == map);
  EXPECT_TRUE(map_of_log(messages.bag(), "run.bag") == map);
}

}  // namespace
}  // namespace outrider
