#include "page_slam.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "outrider/core/units.hpp"
#include "outrider/log/append.hpp"
#include "outrider/log/conversions.hpp"
#include "outrider/log/mapping_messages.hpp"
#include "outrider/log/ros_sensor_messages.hpp"
#include "outrider/log/topics.hpp"
#include "outrider/report/json.hpp"

namespace outrider {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

outrider_msgs::RunInfo mapping(Vec2 low, Vec2 high) {
  outrider_msgs::RunInfo info;
  info.job = "slam";
  info.engine = "laser";
  info.world = "hall";
  info.low = point_of(low);
  info.high = point_of(high);
  return info;
}

/// A log of a mapping without steps.
Log begun() {
  Log log;
  log.append(topic::run, 0.0, mapping({none, none}, {none, none}));
  return log;
}

PageReport page_of(const Log& log) {
  Report report;
  report.job = "slam";
  report.status = "done";
  return page_report(report, log);
}

void log_mount(Log& log, const Pose2& robot_T_laser) {
  tf2_msgs::TFMessage transforms;
  transforms.transforms.push_back(transform_of(0.0, robot_T_laser, "base_link", "laser"));
  log.append(topic::static_transforms, 0.0, std::move(transforms));
}

/// The points of a scan of these ranges, as the page has them.
std::vector<Vec2> points_of_scan(std::vector<float> ranges, const Pose2& robot_T_laser) {
  Log log = begun();
  log_mount(log, robot_T_laser);
  sensor_msgs::LaserScan scan;
  scan.angle_increment = static_cast<float>(0.5 * pi);
  scan.range_min = 0.1F;
  scan.range_max = 5.0F;
  scan.ranges = std::move(ranges);
  log.append(topic::scan, 0.0, std::move(scan));
  return page_of(log).slam->scans.at(0).points;
}

TEST(PageSlam, PointsLieWhereTheBeamsEnd) {
  const Pose2 mount{{0.2, 0.1}, 0.5 * pi};
  const auto points = points_of_scan({1.0F, NAN, 9.0F, 0.01F}, mount);
  ASSERT_EQ(points.size(), 1U);
  EXPECT_NEAR(distance(points[0], Vec2{0.2, 1.1}), 0.0, 1e-12);
  const auto many = points_of_scan(std::vector<float>(1000, 2.0F), mount);
  EXPECT_LE(many.size(), 180U);
  EXPECT_GT(many.size(), 120U);
}

/// A drive of so many steps whose belief wanders off and comes back at a loop.
Log steps_of(std::size_t steps) {
  Log log = begun();
  for (std::size_t i = 0; i < steps; ++i) {
    const double t = 0.1 * static_cast<double>(i);
    const Pose2 believed{Vec2{t, std::sin(t) + 0.001 * std::fmod(t, 7.0)}, std::cos(t)};
    log_belief(log, t, believed, Eigen::Vector3d(0.01, 0.04, 0.0001).asDiagonal(), i % 70 == 0);
    nav_msgs::Odometry odometry;
    odometry.pose.pose = pose_of(Pose2{{t, 0.0}, 0.0});
    log.append(topic::odometry, t, std::move(odometry));
    log.append(topic::sightings, t, outrider_msgs::Sightings{{{1.0, 0.0}, {0.0, 1.0}}});
  }
  return log;
}

/// The same drive when its path is settled.
PageReport recorded(std::size_t steps) {
  Log log = steps_of(steps);
  const double end_s = log.end_s();
  std::vector<double> times_s;
  std::vector<Pose2> settled;
  std::vector<Vec2> reference;
  for (std::size_t i = 0; i < steps; ++i) {
    times_s.push_back(0.1 * static_cast<double>(i));
    settled.push_back({{times_s[i], std::sin(times_s[i])}, std::cos(times_s[i])});
    reference.push_back(settled.back().position + Vec2{0.0, 0.01});
  }
  log.append(topic::loops, end_s, outrider_msgs::Loops{{{1.0, {0.0, 0.0}, {1.0, 1.0}}}});
  log.append(topic::landmarks, end_s,
             outrider_msgs::Landmarks{{{7, 0.5, {1.0, 2.0}, 0.1, 0.2, 0.5, 3, {1.1, 2.0}},
                                       {8, 0.6, {3.0, 2.0}, 0.1, 0.2, 0.5, 3, {none, none}}}});
  log.append(topic::trajectory, end_s, path_of(times_s, settled));
  log.append(topic::reference, end_s, path_of(0.0, reference));
  log.append(topic::run, end_s, mapping({-1.0, -2.0}, {end_s + 1.0, 3.0}));
  return page_of(log);
}

TEST(PageSlam, AShortLogStaysAsItWas) {
  const PageReport report = recorded(500);
  ASSERT_EQ(report.track.size(), 500U);
  const ReportSlam& slam = *report.slam;
  EXPECT_EQ(slam.engine, "laser");
  EXPECT_EQ(slam.beliefs.size(), 500U);
  EXPECT_EQ(slam.odometry.size(), 500U);
  EXPECT_EQ(slam.reference.size(), 500U);
  EXPECT_NEAR(slam.beliefs[10].sigma_y_m, 0.2, 1e-12);
  EXPECT_NEAR(slam.beliefs[35].pose.position.y - report.track[35].pose.position.y, 0.0035, 1e-12);
  EXPECT_TRUE(slam.beliefs[70].corrected);
  EXPECT_FALSE(slam.beliefs[71].corrected);
  ASSERT_EQ(slam.landmarks.size(), 2U);
  EXPECT_FALSE(slam.landmarks[1].truth);
}

TEST(PageSlam, UntilItIsSettledThePathIsThatOfTheBeliefs) {
  const PageReport report = page_of(steps_of(100));
  ASSERT_EQ(report.track.size(), 100U);
  for (std::size_t i = 0; i < 100; ++i) EXPECT_EQ(report.track[i].pose, report.slam->beliefs[i].pose);
  EXPECT_EQ(report.slam->scans.size(), 10U) << "every tenth";
  EXPECT_TRUE(report.slam->reference.empty());
}

TEST(PageSlam, ALongLogIsThinnedWithoutALieBetweenItsRows) {
  const PageReport whole = recorded(5000), thin = recorded(9000);
  EXPECT_EQ(whole.track.size(), 5000U);
  EXPECT_LE(thin.track.size(), 5000U);
  EXPECT_GT(thin.track.size(), 500U);
  ASSERT_EQ(thin.slam->beliefs.size(), thin.track.size());
  ASSERT_EQ(thin.slam->reference.size(), thin.track.size());
  EXPECT_LE(thin.slam->scans.size(), 400U);
  EXPECT_GT(thin.slam->scans.size(), 200U);
  constexpr double within = 0.02;
  std::size_t row = 0;
  for (int i = 0; i < 9000; ++i) {
    const double t = 0.1 * i;
    while (row + 2 < thin.track.size() && thin.track[row + 1].time_s <= t) ++row;
    const TrackSample &a = thin.track[row], &b = thin.track[row + 1];
    const double share = (t - a.time_s) / (b.time_s - a.time_s);
    const Vec2 at = a.pose.position + share * (b.pose.position - a.pose.position);
    EXPECT_NEAR(at.y, std::sin(t), within + 1e-9) << t;
    const Vec2 lower = thin.slam->odometry[row], upper = thin.slam->odometry[row + 1];
    EXPECT_NEAR(lower.x + share * (upper.x - lower.x), t, within + 1e-9);
  }
  int recognised = 0;
  for (const ReportBelief& belief : thin.slam->beliefs) recognised += belief.corrected ? 1 : 0;
  EXPECT_GE(recognised, 120);
}

TEST(PageSlam, ReadBackItIsTheSame) {
  PageReport report = recorded(300);
  report.slam->map.emplace();
  report.slam->map->columns = report.slam->map->rows = 1;
  report.slam->map->state_runs = report.slam->map->known_runs = {0, 1};
  const std::string text = to_json(report);
  const auto again = report_from_json(text);
  ASSERT_TRUE(again) << again.error().sentence;
  EXPECT_EQ(to_json(*again), text);
  ASSERT_TRUE(again->slam);
  EXPECT_EQ(again->slam->landmarks[0].id, 7);
  EXPECT_EQ(again->slam->landmarks[0].truth, (Vec2{1.1, 2.0}));
  EXPECT_EQ(again->slam->scans.size(), report.slam->scans.size());
  EXPECT_EQ(again->slam->scans[0].points[1], (Vec2{0.0, 1.0}));
}

TEST(PageSlam, LoopsBeyondTheBoundGoEquallyFarApart) {
  Log log = begun();
  outrider_msgs::Loops all;
  for (int i = 0; i < 5000; ++i) all.loops.push_back({1.0 * i, {}, {}});
  log.append(topic::loops, 5000.0, std::move(all));
  const auto loops = page_of(log).slam->loops;
  ASSERT_EQ(loops.size(), 2000U);
  for (std::size_t i = 1; i < loops.size(); ++i) {
    const double apart_s = loops[i].time_s - loops[i - 1].time_s;
    EXPECT_TRUE(apart_s == 2.0 || apart_s == 3.0);
  }
}

TEST(PageSlam, OfSeveralRobotsEachHasItsPath) {
  Log log = begun();
  const std::vector<double> times_s = {0.0, 2.0};
  const std::vector<Pose2> first = {{{0.0, 0.0}, 0.0}, {{1.0, 0.0}, 0.0}};
  const std::vector<Pose2> second = {{{5.0, 0.0}, 0.0}, {{5.0, 1.0}, 0.0}};
  log.append(topic::trajectory, 2.0, path_of(times_s, first));
  EXPECT_TRUE(page_of(log).paths.empty()) << "the track of one robot is enough";
  log.append("/robot_2/trajectory", 2.0, path_of(times_s, second));
  const auto paths = page_of(log).paths;
  ASSERT_EQ(paths.size(), 2U);
  EXPECT_EQ(paths[0].waypoints, (std::vector<Vec2>{{0.0, 0.0}, {1.0, 0.0}}));
  EXPECT_EQ(paths[1].waypoints, (std::vector<Vec2>{{5.0, 0.0}, {5.0, 1.0}}));
  EXPECT_EQ(paths[0].end_s, 2.0);
}

TEST(PageSlam, OtherJobsHaveNone) {
  Log log;
  auto guard = mapping({}, {});
  guard.engine.clear();
  log.append(topic::run, 0.0, std::move(guard));
  EXPECT_FALSE(page_report({}, log).slam);
}

}  // namespace
}  // namespace outrider
