#include "outrider/io/log/laser_topics.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "outrider/log/messages/conversions.hpp"
#include "outrider/log/messages/ros_sensor_messages.hpp"
#include "support/data.hpp"
#include "support/robot_logs.hpp"

namespace outrider {
namespace {

using test::RobotMessages;

sensor_msgs::LaserScan scan_at(double time_s) {
  sensor_msgs::LaserScan scan;
  scan.header = header_of(time_s, "laser");
  scan.angle_min = -1.0F;
  scan.angle_increment = 0.5F;
  scan.angle_max = 1.0F;
  scan.range_min = 0.1F;
  scan.range_max = 10.0F;
  scan.ranges = {1.0F, 2.0F, 3.0F, 4.0F, 5.0F};
  return scan;
}

nav_msgs::Odometry odometry_at(double time_s, const Pose2& pose) {
  nav_msgs::Odometry odometry;
  odometry.header = header_of(time_s, "odom");
  odometry.child_frame_id = "base_footprint";
  odometry.pose.pose = pose_of(pose);
  return odometry;
}

tf2_msgs::TFMessage mount(const geometry_msgs::Quaternion& rotation = {}) {
  auto transform = transform_of(0.0, {{0.2, 0.1}, 0.0}, "base_footprint", "laser");
  transform.transform.rotation = rotation;
  return {{transform}};
}

/// Scans at 0.25 s, 0.75 s, ..., odometry each half second, 1 m apart.
RobotMessages drive(int seconds = 4) {
  RobotMessages log;
  log.add("/tf_static", 0.0, mount());
  for (int i = 0; i <= 2 * seconds; ++i) {
    log.add("/odom", 0.5 * i, odometry_at(0.5 * i, {{1.0 * i, 0.0}, 0.0}));
    log.add("/scan", 0.5 * i + 0.25, scan_at(0.5 * i + 0.25));
  }
  return log;
}

struct Mapped {
  std::vector<LaserLogStep> steps;
  std::optional<Pose2> robot_T_laser;
  std::vector<std::string> warnings;
  std::string fault;
};

class LaserTopicsFile : public ::testing::Test {
 protected:
  Mapped read(const std::string& bytes, const LaserTopicsOptions& options = {}) const {
    Mapped mapped;
    auto source = open_laser_topics(folder_.write("log", bytes), options);
    if (!source) {
      mapped.fault = to_string(source.error());
      return mapped;
    }
    mapped.robot_T_laser = (*source)->robot_T_laser();
    for (;;) {
      auto step = (*source)->next();
      if (!step) mapped.fault = to_string(step.error());
      if (!step || !*step) break;
      mapped.steps.push_back(std::move(**step));
    }
    mapped.warnings = (*source)->warnings();
    return mapped;
  }
  void expect_fault(const std::string& bytes, const std::string& part,
                    const LaserTopicsOptions& options = {}) const {
    const std::string fault = read(bytes, options).fault;
    EXPECT_NE(fault.find(part), std::string::npos) << fault;
  }

  test::Folder folder_;
};

TEST_F(LaserTopicsFile, OdometryIsTakenAtTheTimeOfTheScan) {
  const Mapped mapped = read(drive().mcap());
  EXPECT_EQ(mapped.fault, "");
  ASSERT_EQ(mapped.steps.size(), 9U);
  EXPECT_EQ(mapped.steps[0].motion, Pose2{});
  for (std::size_t i = 1; i < 8; ++i) EXPECT_NEAR(mapped.steps[i].motion.position.x, 1.0, 1e-12) << i;
  EXPECT_NEAR(mapped.steps[8].motion.position.x, 0.5, 1e-12) << "the odometry ends before the last scan";
  EXPECT_EQ(mapped.steps[3].scan.time_s, 1.75);
  EXPECT_EQ(mapped.robot_T_laser, (Pose2{{0.2, 0.1}, 0.0}));
  EXPECT_TRUE(mapped.warnings.empty());
}

TEST_F(LaserTopicsFile, EveryFormatAndEncodingSaysTheSame) {
  const RobotMessages log = drive();
  const Mapped first = read(log.mcap());
  for (const std::string& bytes : {log.mcap(MessageEncoding::ros1), log.mcap(MessageEncoding::json),
                                   log.bag(), log.bag("bz2"), log.bag("lz4"), log.db3()}) {
    const Mapped other = read(bytes);
    EXPECT_EQ(other.fault, "");
    ASSERT_EQ(other.steps.size(), first.steps.size());
    for (std::size_t i = 0; i < first.steps.size(); ++i) {
      EXPECT_EQ(other.steps[i].motion, first.steps[i].motion);
      EXPECT_EQ(other.steps[i].scan.ranges_m, first.steps[i].scan.ranges_m);
      EXPECT_EQ(other.steps[i].scan.first_rad, first.steps[i].scan.first_rad);
      EXPECT_EQ(other.steps[i].scan.time_s, first.steps[i].scan.time_s);
    }
  }
}

TEST_F(LaserTopicsFile, WithoutATopicOdometryComesFromTheTransforms) {
  RobotMessages log;
  log.add("/tf_static", 0.0,
          tf2_msgs::TFMessage{{transform_of(0.0, {{0.3, 0.0}, 0.0}, "base_link", "laser")}});
  for (int i = 0; i <= 4; ++i) {
    const tf2_msgs::TFMessage moved{{transform_of(1.0 * i, {{0.0, 2.0 * i}, 0.5 * i}, "odom", "base_link")}};
    log.add("/tf", 1.0 * i, moved);
    if (i < 4) log.add("/scan", i + 0.5, scan_at(i + 0.5));
  }
  const Mapped mapped = read(log.mcap());
  EXPECT_EQ(mapped.fault, "");
  ASSERT_EQ(mapped.steps.size(), 4U);
  EXPECT_NEAR(mapped.steps[1].motion.heading_rad, 0.5, 1e-12);
  EXPECT_NEAR(norm(mapped.steps[1].motion.position), 2.0, 1e-12);
  EXPECT_EQ(mapped.robot_T_laser, (Pose2{{0.3, 0.0}, 0.0}));
  expect_fault(log.mcap(), "/tf does not join 'world' and 'base_link'", {.odom_frame = "world"});
}

TEST_F(LaserTopicsFile, ALaserUpsideDownIsReversed) {
  RobotMessages turned;
  turned.add("/tf_static", 0.0, mount({1.0, 0.0, 0.0, 0.0}));  // roll by half a turn
  for (int i = 0; i < 3; ++i) {
    auto scan = scan_at(i);
    scan.angle_min = -1.0F;
    scan.ranges[0] = 7.0F;
    turned.add("/odom", i, odometry_at(i, {}));
    turned.add("/scan", i, scan);
  }
  const Mapped mapped = read(turned.mcap());
  ASSERT_EQ(mapped.steps.size(), 3U) << mapped.fault;
  const LaserScan& scan = mapped.steps[0].scan;
  EXPECT_EQ(scan.first_rad, -1.0);
  EXPECT_EQ(scan.step_rad, 0.5);
  EXPECT_EQ(scan.ranges_m, (std::vector<float>{5.0F, 4.0F, 3.0F, 2.0F, 7.0F}));
  EXPECT_NEAR(mapped.robot_T_laser->heading_rad, 0.0, 1e-12);
}

TEST_F(LaserTopicsFile, ClockwiseScansAreReversedAndOnlyReadingsAreKept) {
  constexpr float inf = std::numeric_limits<float>::infinity();
  RobotMessages log;
  auto scan = scan_at(1.0);
  scan.angle_min = 1.0F;
  scan.angle_increment = -0.5F;
  scan.ranges = {0.05F, 11.0F, inf, -inf, std::nanf("")};
  log.add("/odom", 1.0, odometry_at(1.0, {}));
  log.add("/scan", 1.0, scan);
  const Mapped mapped = read(log.mcap());
  ASSERT_EQ(mapped.steps.size(), 1U) << mapped.fault;
  const LaserScan& read = mapped.steps[0].scan;
  EXPECT_EQ(read.first_rad, -1.0);
  EXPECT_EQ(read.step_rad, 0.5);
  for (const std::size_t i : {0U, 1U, 3U, 4U}) EXPECT_TRUE(std::isnan(read.ranges_m[i])) << i;
  EXPECT_EQ(read.ranges_m[2], inf) << "nothing within range_max";
  ASSERT_EQ(mapped.warnings.size(), 1U);
  EXPECT_NE(mapped.warnings[0].find("does not say where the laser of /scan stands on 'base_footprint'"),
            std::string::npos);
  EXPECT_FALSE(mapped.robot_T_laser);
}

TEST_F(LaserTopicsFile, ALaserThatIsTiltedIsRefused) {
  RobotMessages tilted;
  tilted.add("/tf_static", 0.0, mount({0.0, std::sin(0.4), 0.0, std::cos(0.4)}));
  tilted.add("/odom", 0.0, odometry_at(0.0, {}));
  tilted.add("/scan", 0.0, scan_at(0.0));
  expect_fault(tilted.mcap(), "/scan: the laser is tilted by 46 degrees");
}

TEST_F(LaserTopicsFile, SeveralTopicsAreNamedInTheRefusal) {
  RobotMessages log = drive(1);
  log.add("/rear", 9.0, scan_at(9.0));
  expect_fault(log.mcap(),
               "--scan: the log has several topics of the type sensor_msgs/msg/LaserScan: /scan, /rear");
  EXPECT_EQ(read(log.mcap(), {.scan = "/scan"}).fault, "");
  expect_fault(log.mcap(),
               "--odom: the messages of /rear are sensor_msgs/msg/LaserScan, and not nav_msgs/msg/Odometry",
               {.scan = "/scan", .odom = "/rear"});
  RobotMessages none;
  none.add("/odom", 0.0, odometry_at(0.0, {}));
  expect_fault(none.mcap(),
               "--scan: the log has no topic of the type sensor_msgs/msg/LaserScan; it has /odom");
  RobotMessages alone;
  alone.add("/scan", 0.0, scan_at(0.0));
  expect_fault(alone.mcap(), "--odom: the log has no topic of the type nav_msgs/msg/Odometry; it has /scan");
}

TEST_F(LaserTopicsFile, TimesDoNotGoBack) {
  RobotMessages log = drive(2);
  log.add("/scan", 3.0, scan_at(1.0));
  expect_fault(log.mcap(),
               "/scan: the time of the scans goes back from 2.250 s to 1.000 s; cut the log there");
  RobotMessages looped = drive(2);
  looped.add("/odom", 3.0, odometry_at(1.0, {}));
  looped.add("/scan", 3.0, scan_at(3.0));
  expect_fault(looped.mcap(), "/odom: the time of the odometry goes back from 2.000 s to 1.000 s");
}

TEST_F(LaserTopicsFile, ScansWithoutOdometryAreLeftOut) {
  RobotMessages log;
  log.add("/tf_static", 0.0, mount());
  for (int i = 0; i < 10; ++i) {
    log.add("/scan", i, scan_at(i));
    if (i == 5) log.add("/odom", i, odometry_at(i, {}));
  }
  const Mapped mapped = read(log.mcap());
  EXPECT_EQ(mapped.steps.size(), 1U) << mapped.fault;
  EXPECT_EQ(mapped.warnings, std::vector<std::string>{"9 scans without odometry were left out"});
  RobotMessages far;
  far.add("/odom", 1.0, odometry_at(1.0, {}));
  far.add("/scan", 5.0, scan_at(5.0));
  expect_fault(far.mcap(), "/scan: none of its 1 scans has odometry of /odom within 0.5 s");
}

TEST_F(LaserTopicsFile, AScanThatIsNoneIsLeftOut) {
  RobotMessages log = drive(1);
  auto wrong = scan_at(1.5);
  wrong.range_max = std::numeric_limits<float>::infinity();
  log.add("/odom", 1.5, odometry_at(1.5, {}));
  log.add("/scan", 1.5, wrong);
  const Mapped mapped = read(log.mcap());
  EXPECT_EQ(mapped.steps.size(), 3U) << mapped.fault;
  ASSERT_EQ(mapped.warnings.size(), 1U);
  EXPECT_NE(mapped.warnings[0].find("1 scans were left out: ranges from 0.1"), std::string::npos)
      << mapped.warnings[0];
}

TEST_F(LaserTopicsFile, ACutLogIsReadAndSaidToBeCut) {
  const std::string whole = drive(60).mcap();
  const Mapped mapped = read(whole.substr(0, whole.size() / 2));
  EXPECT_EQ(mapped.fault, "");
  EXPECT_GT(mapped.steps.size(), 10U);
  ASSERT_EQ(mapped.warnings.size(), 1U);
  EXPECT_NE(mapped.warnings[0].find("ends early"), std::string::npos);
}

}  // namespace
}  // namespace outrider
