// Mapping from logs of ROS topics: the same map as from the same scans in memory, whatever the format.
#include <gtest/gtest.h>

#include <cmath>

#include "outrider/io/log/laser_topics.hpp"
#include "outrider/job/run_job.hpp"
#include "outrider/job/sensor_log.hpp"
#include "outrider/jobs/slam/job.hpp"
#include "outrider/jobs/slam/laser/laser_run.hpp"
#include "outrider/log/mcap/mcap_sink.hpp"
#include "outrider/log/messages/conversions.hpp"
#include "outrider/log/messages/ros_sensor_messages.hpp"
#include "support/data.hpp"
#include "support/robot_logs.hpp"

namespace outrider {
namespace {

constexpr double start_s = 1'600'000'000.0;
const Pose2 robot_T_laser{{0.15, 0.0}, 0.0};

/// A scan of a room of 8 m by 5 m, whose numbers a message holds exactly.
LaserScan scan_from(const Pose2& robot, double time_s) {
  const Pose2 laser = compose(robot, robot_T_laser);
  LaserScan scan{time_s, static_cast<double>(-2.0F), static_cast<double>(0.02F), 0.125, 30.0, {}};
  for (int beam = 0; beam < 200; ++beam) {
    const Vec2 way = direction(laser.heading_rad + scan.first_rad + beam * scan.step_rad);
    const double x_m = (way.x > 0 ? 8.0 - laser.position.x : -laser.position.x) / way.x;
    const double y_m = (way.y > 0 ? 5.0 - laser.position.y : -laser.position.y) / way.y;
    scan.ranges_m.push_back(static_cast<float>(std::min(x_m, y_m)));
  }
  return scan;
}

/// Poses of the robot, and what odometry says, which drifts.
struct Step {
  double time_s = 0.0;
  Pose2 robot;
  Pose2 odometry;
};

std::vector<Step> drive() {
  std::vector<Step> steps;
  Step step{start_s, {{3.0, 0.45}, 0.0}, {{0.0, 0.0}, 0.0}};  // a circle of 2 m radius
  for (int i = 0; i < 80; ++i) {
    steps.push_back(step);
    step.time_s += 0.25;
    step.robot = compose(step.robot, {{0.1, 0.0}, 0.05});
    step.odometry = compose(step.odometry, {{0.102, 0.0}, 0.048});
  }
  return steps;
}

/// The same as a log reads it: headings come back from quaternions.
LaserLog in_memory() {
  LaserLog log;
  std::optional<Pose2> before;
  for (const Step& step : drive()) {
    const Pose2 odometry = pose_of(pose_of(step.odometry));
    const Pose2 motion = wrap_heading(relative_pose(before.value_or(odometry), odometry));
    log.steps.push_back({motion, scan_from(step.robot, step.time_s)});
    before = odometry;
  }
  return log;
}

/// As Outrider logs them.
Log logged() {
  Log log;
  log_mount(log, "laser", robot_T_laser, 0.2);
  for (const Step& step : drive()) {
    log_odometry(log, step.time_s, step.odometry);
    log_scan(log, step.time_s, scan_from(step.robot, step.time_s));
  }
  return log;
}

/// The messages of a log for the writers of other formats.
test::RobotMessages messages_of(const Log& log) {
  test::RobotMessages messages;
  messages.add("/tf_static", 0.0, *log.latest<tf2_msgs::TFMessage>("/tf_static"));
  const auto& scans = log.messages<sensor_msgs::LaserScan>("/scan");
  const auto& odometry = log.messages<nav_msgs::Odometry>("/odom");
  for (std::size_t i = 0; i < scans.size(); ++i) {
    messages.add("/odom", odometry[i].time_s(), odometry[i].message);
    messages.add("/scan", scans[i].time_s(), scans[i].message);
  }
  return messages;
}

LaserSlamOptions options() {
  LaserSlamOptions options = laser_options_for_logs();
  options.robot_T_laser = robot_T_laser;
  return options;
}

TEST(LaserTopicsRun, TheMapOfALogIsThatOfItsScansInMemoryInEveryFormat) {
  const auto direct = run_laser_log(in_memory(), options(), {}, [] { return 0.0; });
  ASSERT_TRUE(direct) << to_string(direct.error());
  const test::RobotMessages messages = messages_of(logged());
  const test::Folder folder;
  for (const std::string& bytes : {messages.mcap(), messages.mcap(MessageEncoding::json), messages.bag("bz2"),
                                   messages.bag("lz4"), messages.db3()}) {
    auto source = open_laser_topics(folder.write("log", bytes), {});
    ASSERT_TRUE(source) << to_string(source.error());
    EXPECT_EQ((*source)->robot_T_laser(), robot_T_laser);
    const auto mapped = run_laser_log(**source, options(), {}, [] { return 0.0; });
    ASSERT_TRUE(mapped) << to_string(mapped.error());
    EXPECT_EQ(mapped->steps, direct->steps);
    EXPECT_NEAR(mapped->log_s.value(), direct->log_s.value(), 1e-6);
    EXPECT_TRUE(mapped->slam.map().frame() == direct->slam.map().frame());
    EXPECT_EQ(mapped->slam.map().occupancy().cells, direct->slam.map().occupancy().cells);
    EXPECT_EQ(mapped->slam.trajectory(), direct->slam.trajectory());
  }
}

/// Runs the job on a file of a name.
Outcome<Run> run_slam(const std::string& path, const Changes& changes = {}) {
  SlamJob task;
  if (auto ok = change(task, {{"log", path}}); !ok) return pass_on(ok);
  if (auto ok = change(task, changes); !ok) return pass_on(ok);
  return run_task(slam_job(), task);
}

std::string file_of(const Run& run, const std::string& name) {
  for (const NamedContent& file : run.files) {
    if (file.path == name) return file.content;
  }
  return {};
}

TEST(LaserTopicsRun, TheJobMapsARunOfOutrider) {
  const test::Folder folder;
  std::filesystem::create_directory(folder.path / "r");
  const std::string path = (folder.path / "r" / "run.mcap").string();
  {
    auto writer = McapWriter::create(path);
    ASSERT_TRUE(writer);
    McapSink sink(std::move(*writer));
    Log log = logged();
    log.add_sink(sink);
    ASSERT_TRUE(sink.finish());
  }
  const auto run = run_slam(path);
  ASSERT_TRUE(run) << to_string(run.error());
  EXPECT_EQ(run->report.status, "done") << run->report.reason;
  EXPECT_TRUE(run->report.warnings.empty());
  EXPECT_GT(file_of(*run, "map.pgm").size(), 1000U);
  EXPECT_EQ(file_of(*run, "trajectory.tum").substr(0, 57),
            "# time x y z qx qy qz qw\n1600000000.000000000 0 0 0 0 0 0");
  const auto by_folder = run_slam((folder.path / "r").string());
  ASSERT_TRUE(by_folder) << to_string(by_folder.error());
  EXPECT_EQ(file_of(*by_folder, "map.pgm"), file_of(*run, "map.pgm"));
  // The log of the run grows with the keyframes, not with the scans.
  const auto& kept = run->log.messages<sensor_msgs::LaserScan>("/scan");
  EXPECT_LT(kept.size(), 60U);
  EXPECT_GT(kept.size(), 10U);
}

TEST(LaserTopicsRun, ATaskRunsTwice) {
  const test::Folder folder;
  SlamJob task;
  ASSERT_TRUE(change(task, {{"log", folder.write("log", messages_of(logged()).bag())}}));
  ASSERT_TRUE(task.load());
  outrider::Run first, second;
  ASSERT_TRUE(task.run(first, {}));
  const auto again = task.run(second, {});
  ASSERT_TRUE(again) << to_string(again.error());
  EXPECT_EQ(file_of(second, "map.pgm"), file_of(first, "map.pgm"));
}

TEST(LaserTopicsRun, TheMountOfTheOptionsWins) {
  const test::Folder folder;
  SlamJob task;
  ASSERT_TRUE(
      change(task, {{"log", folder.write("log", messages_of(logged()).bag())}, {"laser.laser_x", "1.5"}}));
  ASSERT_TRUE(task.load());
  EXPECT_EQ(task.scenario.laser.robot_T_laser.position.x, 1.5);
  SlamJob other;
  ASSERT_TRUE(change(other, {{"log", (folder.path / "log").string()}}));
  ASSERT_TRUE(other.load());
  EXPECT_EQ(other.scenario.laser.robot_T_laser.position.x, 0.15);
}

TEST(LaserTopicsRun, FaultsNameTheTopicAndTheOption) {
  const test::Folder folder;
  const std::string path = folder.write("log", messages_of(logged()).mcap());
  const auto fault_of = [&](const Changes& changes) { return to_string(run_slam(path, changes).error()); };
  EXPECT_NE(fault_of({{"scan", "/front"}}).find("the log has no topic '/front'"), std::string::npos);
  EXPECT_NE(fault_of({{"odom", "/scan"}}).find("--odom: the messages of /scan are"), std::string::npos);
}

}  // namespace
}  // namespace outrider
