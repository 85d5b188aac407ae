#include "outrider/io/log/carmen_log.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "outrider/slam/laser/laser_slam.hpp"

namespace outrider {
namespace {

Outcome<LaserLog> read(std::string_view text) { return laser_log_from_carmen({text, "robot.log"}, {}); }

TEST(CarmenLog, OdometryIsTakenBackFromTheFrameOfTheScanBefore) {
  const auto log = read(
      "# a comment\n"
      "PARAM robot_frontlaser_offset 0.0 nohost 0\n"
      "ODOM 7 7 1 0 0 0 0 host 0\n"
      "FLASER 3 1.5 2.5 3.5 1 2 1.5707963267948966 1 2 1.5707963267948966 10 host 10\n"
      "ODOM 5 5 5 0 0 0 10 host 10\n"
      "ODOM 1 2.5 1.6707963267948966 0 0 0 11 host 11\n"
      "FLASER 3 1 nan 81.9 9 9 9 9 9 9 12 host 12\r\n"
      "NEFF 4\n"
      "FLASER 0 9 9 9 9 9 9 13 host 13\n");
  ASSERT_TRUE(log) << to_string(log.error());
  ASSERT_EQ(log->steps.size(), 3U);
  EXPECT_EQ(log->steps[0].motion, Pose2{});
  EXPECT_NEAR(log->steps[1].motion.position.x, 0.5, 1e-12);
  EXPECT_NEAR(log->steps[1].motion.position.y, 0.0, 1e-12);
  EXPECT_NEAR(log->steps[1].motion.heading_rad, 0.1, 1e-12);
  EXPECT_EQ(log->steps[2].motion, Pose2{}) << "no ODOM: it stood still";
  EXPECT_EQ(log->reference[1], (Pose2{{9, 9}, 9}));
  const LaserScan& scan = log->steps[1].scan;
  EXPECT_EQ(scan.time_s, 12.0);
  EXPECT_DOUBLE_EQ(scan.first_rad, -0.5 * pi);
  EXPECT_DOUBLE_EQ(scan.step_rad, 0.5 * pi);
  EXPECT_EQ(scan.ranges_m[0], 1.0F);
  EXPECT_TRUE(std::isnan(scan.ranges_m[1]));
  EXPECT_TRUE(std::isnan(scan.ranges_m[2])) << "as far as the laser says it can see";
  EXPECT_FALSE(check(log->steps[2].scan)) << "a scan without beams; LaserSlam leaves it out";
}

TEST(CarmenLog, TheBeamsTellTheirStep) {
  for (const auto& [beams, step_deg] : {std::pair{180, 1.0}, {181, 1.0}, {360, 0.5}, {361, 0.5}}) {
    std::string line = "FLASER " + std::to_string(beams);
    for (int i = 0; i < beams; ++i) line += " 1";
    const auto log = read(line + " 0 0 0 0 0 0 0 host 0\n");
    ASSERT_TRUE(log);
    EXPECT_NEAR(log->steps[0].scan.step_rad, radians(step_deg), 1e-12);
  }
}

TEST(CarmenLog, WithoutOdometryThePosesAreIt) {
  const auto log = read("FLASER 1 1 0 0 0 0 0 0 0 h 0\nFLASER 1 1 1 0 0 1 0 0 1 h 1\n");
  ASSERT_TRUE(log);
  EXPECT_EQ(log->steps[1].motion.position, (Vec2{1, 0}));
  EXPECT_TRUE(log->reference.empty());
}

/// A robot that drives 0.1 m for each ODOM, with a scan after every third one. Of a corrected log, the poses
/// of the scans are off by what the odometry errs, to the side, and the next ODOM lines start from there.
std::string drive_log(const std::string& kind) {
  std::string text;
  double x = 0.0, y = 0.0;
  const auto odom = [&] { text += fmt::format("ODOM {} {} 0 0.5 0 0 0 host 0\n", x, y); };
  for (int i = 0; i < 60; ++i) {
    x += 0.1;
    odom();
    if (i % 3 != 2) continue;
    const double between = kind == "between" ? 0.04 : 0.0, lag = kind == "lags" ? 0.1 : 0.0;
    if (kind == "corrected") y += i % 2 == 0 ? 0.03 : -0.05;
    text += fmt::format("FLASER 2 1 1 {0} {1} 0 {0} {1} 0 {2} host {2}\n", x + between + lag, y, i);
    if (kind == "corrected") odom();
  }
  return text;
}

TEST(CarmenLog, PosesOfTheOdometryAreNoReference) {
  for (const std::string kind : {"same", "between", "lags"}) {
    const auto log = read(drive_log(kind));
    ASSERT_TRUE(log);
    EXPECT_TRUE(log->reference.empty()) << kind;
    for (std::size_t i = 1; i < log->steps.size(); ++i)
      EXPECT_NEAR(log->steps[i].motion.position.x, 0.3, 1e-9) << kind;
  }
  const auto corrected = read(drive_log("corrected"));
  ASSERT_TRUE(corrected);
  EXPECT_EQ(corrected->reference.size(), corrected->steps.size());
}

TEST(CarmenLog, ReadsTheNewerFormOfAScan) {
  const std::string text =
      "ROBOTLASER1 0 -1.5 3 0.5 40 0.01 0 7 1 2 3 4 5 41 nan 2 9 9 1.25 2 0.5 1 2 0.5 0 0 0 0 0 7.5 host 1\n"
      "FLASER 2 1 1 0 0 0 0 0 0 8 host 8\n";
  const auto log = read(text);
  ASSERT_TRUE(log) << to_string(log.error());
  ASSERT_EQ(log->steps.size(), 1U) << "the other form has the same scan";
  const LaserScan& scan = log->steps[0].scan;
  EXPECT_EQ(scan.time_s, 7.5);
  EXPECT_EQ(scan.first_rad, -1.5);
  EXPECT_EQ(scan.step_rad, 0.5);
  ASSERT_EQ(scan.ranges_m.size(), 7U);
  EXPECT_EQ(scan.ranges_m[4], 5.0F);
  EXPECT_TRUE(std::isnan(scan.ranges_m[5])) << "32 m is the most that a log is taken to measure";
  ASSERT_TRUE(log->robot_T_laser);
  EXPECT_NEAR(log->robot_T_laser->position.x, 0.25 * std::cos(0.5), 1e-12);
  EXPECT_NEAR(log->robot_T_laser->position.y, -0.25 * std::sin(0.5), 1e-12);
  EXPECT_TRUE(is_carmen_log(text));
  for (const std::string cut : {"ROBOTLASER1 0 -1.5 3 0.5 40 0.01 0 3 1 2 3 0 1 2 0.5", "ROBOTLASER1 0 1 2",
                                "ROBOTLASER1 0 -1.5 3 0.5 40 0.01 0 99 1 2 3 0 1 2 0.5"}) {
    const auto refused = read(cut + "\n");
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().sentence.find("ROBOTLASER1 type start"), std::string::npos);
  }
}

TEST(CarmenLog, RefusesBrokenLinesByTheirNumber) {
  const struct {
    std::string text, where, says;
  } cases[] = {
      {"ODOM 1 2\n", "robot.log:1", "ODOM x y heading"},
      {"ODOM\n", "robot.log:1", "ODOM x y heading"},
      {"ODOM 1 2 inf\n", "robot.log:1", "'inf'"},
      {"PARAM a b\nFLASER 3 1 2\n", "robot.log:2", "10 are expected"},
      {"FLASER\n", "robot.log:1", "number of beams"},
      {"FLASER -1 0 0 0 0 0 0 0 h 0\n", "robot.log:1", "'-1'"},
      {"FLASER 99999999999 1\n", "robot.log:1", "'99999999999'"},
      {"FLASER 1 one 0 0 0 0 0 0 0 h 0\n", "robot.log:1", "'one'"},
      {"FLASER 1 1 0 0 x 0 0 0 0 h 0\n", "robot.log:1", "'x'"},
      {"FLASER 1 1 0 0 0 0 0 0 now h 0\n", "robot.log:1", "'now'"},
      {"ODOM 1 2 3\n", "robot.log", "at least one FLASER or ROBOTLASER1 line"},
      {"", "robot.log", "at least one FLASER or ROBOTLASER1 line"},
  };
  for (const auto& c : cases) {
    const auto log = read(c.text);
    ASSERT_FALSE(log) << c.text;
    EXPECT_EQ(log.error().where, c.where);
    EXPECT_NE(log.error().sentence.find(c.says), std::string::npos) << log.error().sentence;
  }
}

TEST(CarmenLog, IsToldByItsFirstWord) {
  EXPECT_TRUE(is_carmen_log("# a\n\nPARAM x y\n"));
  EXPECT_TRUE(is_carmen_log("FLASER 0"));
  EXPECT_FALSE(is_carmen_log("ODOMETRY 0 1 0\n"));
  EXPECT_FALSE(is_carmen_log(""));
}

}  // namespace
}  // namespace outrider
