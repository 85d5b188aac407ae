#include "outrider/report/slam_record.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "outrider/core/rng.hpp"
#include "outrider/core/units.hpp"
#include "outrider/report/json.hpp"
#include "outrider/report/pictures.hpp"
#include "outrider/report/scan_map.hpp"
#include "outrider/slam/laser_slam.hpp"
#include "support/random_cases.hpp"

namespace outrider {
namespace {

/// How far it is to the walls of a room of 6 x 4 m, or to a pillar in it.
double range_in_room(Vec2 from, double bearing_rad) {
  const Vec2 d = direction(bearing_rad);
  double range = std::numeric_limits<double>::infinity();
  const auto wall = [&](double along, double speed) {
    if (speed > 1e-12) range = std::min(range, along / speed);
  };
  wall(6.0 - from.x, d.x);
  wall(from.x, -d.x);
  wall(4.0 - from.y, d.y);
  wall(from.y, -d.y);
  const Vec2 to = Vec2{3.0, 2.6} - from;
  const double nearest = dot(to, d), aside2 = norm(to) * norm(to) - nearest * nearest;
  if (nearest > 0.0 && aside2 < 0.09) range = std::min(range, nearest - std::sqrt(0.09 - aside2));
  return range;
}

LaserScan scan_from(const Pose2& pose, double time_s) {
  LaserScan scan{time_s, -pi, radians(3.0), 0.02, 8.0, {}};
  for (int i = 0; i < 120; ++i) {
    scan.ranges_m.push_back(static_cast<float>(
        range_in_room(pose.position, pose.heading_rad + scan.first_rad + i * scan.step_rad)));
  }
  return scan;
}

/// Rounds on a circle in the room; the wheels count too little.
struct Rounds {
  std::vector<Pose2> poses;
  std::vector<Pose2> motions;  ///< by odometry
  std::vector<LaserScan> scans;

  explicit Rounds(int steps) {
    for (int i = 0; i < steps; ++i) {
      const double angle = 0.08 * i;
      poses.push_back({Vec2{3.0, 1.6} + 1.0 * direction(angle - 0.5 * pi), wrap_angle(angle)});
      const Pose2 motion =
          i == 0 ? Pose2{} : wrap_heading(relative_pose(poses[poses.size() - 2], poses.back()));
      motions.push_back({0.97 * motion.position, motion.heading_rad + 0.002});
      scans.push_back(scan_from(poses.back(), 0.5 * i));
    }
  }
};

TEST(SlamRecord, TheMapIsThatOfTheMapper) {
  const Rounds rounds(100);
  LaserSlamOptions options;
  options.draw_late = true;
  options.robot_T_laser = {{0.1, -0.05}, 0.3};
  auto slam = LaserSlam::begin(options, rounds.poses.front());
  ASSERT_TRUE(slam);
  ScanMap map(options.map, options.robot_T_laser);
  for (std::size_t i = 0; i < rounds.scans.size(); ++i) {
    const auto step = slam->advance(rounds.motions[i], rounds.scans[i]);
    ASSERT_TRUE(step);
    if (step->kept) map.add(step->pose, rounds.scans[i], rounds.scans[i].time_s, i + 1);
  }
  slam->settle();
  map.redraw(slam->trajectory());
  EXPECT_EQ(map.map().occupancy().frame, slam->map().occupancy().frame);
  EXPECT_EQ(map.map().occupancy().cells, slam->map().occupancy().cells);
  const ReportMap drawn = map.drawn(1'000'000);
  int known = 0, first = 0;
  for (std::size_t i = 0; i < drawn.state_runs.size(); i += 2)
    known += drawn.state_runs[i] < 2 ? drawn.state_runs[i + 1] : 0;
  for (std::size_t i = 0; i < drawn.known_runs.size(); i += 2)
    first += drawn.known_runs[i] == 0 ? drawn.known_runs[i + 1] : 0;
  EXPECT_GT(known, 5000);
  EXPECT_GT(first, 0);
  EXPECT_LT(first, drawn.columns * drawn.rows);
}

TEST(SlamRecord, TimesAreThoseOfTheLogOrTenASecond) {
  EXPECT_EQ(run_times({100.0, 100.5, 102.0}), (std::vector<double>{0.0, 0.5, 2.0}));
  for (const auto& useless : {std::vector<double>{0.0, 0.0, 0.0}, {3.0, 2.0, 4.0}, {0.0, NAN, 1.0}}) {
    const auto times = run_times(useless);
    EXPECT_NEAR(times[1], 0.1, 1e-12);
    EXPECT_NEAR(times[2], 0.2, 1e-12);
  }
  EXPECT_TRUE(run_times({}).empty());
  std::vector<double> stumbling;
  for (int i = 0; i < 20; ++i) stumbling.push_back(i == 7 ? 5.5 : i);
  stumbling = run_times(stumbling);
  EXPECT_EQ(stumbling[7], 6.0);
  EXPECT_EQ(stumbling[8], 8.0);
}

TEST(SlamRecord, PointsLieWhereTheBeamsEnd) {
  const Pose2 mount{{0.2, 0.1}, 0.5 * pi};
  LaserScan scan{0.0, 0.0, 0.5 * pi, 0.1, 5.0, {1.0F, NAN, 9.0F, 0.01F}};
  const auto points = points_of(scan, mount);
  ASSERT_EQ(points.size(), 1U);
  EXPECT_NEAR(distance(points[0], Vec2{0.2, 1.1}), 0.0, 1e-12);
  scan.ranges_m.assign(1000, 2.0F);
  EXPECT_LE(points_of(scan, mount).size(), 180U);
  EXPECT_GT(points_of(scan, mount).size(), 120U);
}

/// A drive of so many steps whose belief wanders off and comes back at a loop.
Report recorded(std::size_t steps) {
  Report report;
  report.job = "slam";
  report.status = "done";
  report.world_name = "hall";
  SlamRecord record(report, "laser", 0.1 * static_cast<double>(steps));
  std::vector<Pose2> settled;
  std::vector<Vec2> reference;
  for (std::size_t i = 0; i < steps; ++i) {
    const double t = 0.1 * static_cast<double>(i);
    settled.push_back({{t, std::sin(t)}, std::cos(t)});
    reference.push_back(settled.back().position + Vec2{0.0, 0.01});
    const Pose2 believed{settled.back().position + Vec2{0.0, 0.001 * std::fmod(t, 7.0)},
                         settled.back().heading_rad};
    record.note(
        {t, believed, Eigen::Vector3d(0.01, 0.04, 0.0001).asDiagonal(), {{t, 0.0}, 0.0}, i % 70 == 0});
    record.note_scan([] { return std::vector<Vec2>{{1.0, 0.0}, {0.0, 1.0}}; });
  }
  report.slam->loops.push_back({1.0, {0.0, 0.0}, {1.0, 1.0}});
  report.slam->landmarks.push_back({7, 0.5, {1.0, 2.0}, 0.1, 0.2, 0.5, 3, Vec2{1.1, 2.0}});
  record.settle(settled, reference);
  report.bounds = bounds_of(report);
  return report;
}

TEST(SlamRecord, AShortLogStaysAsItWas) {
  const Report report = recorded(500);
  ASSERT_EQ(report.track.size(), 500U);
  const ReportSlam& slam = *report.slam;
  EXPECT_EQ(slam.beliefs.size(), 500U);
  EXPECT_EQ(slam.odometry.size(), 500U);
  EXPECT_EQ(slam.reference.size(), 500U);
  EXPECT_EQ(metric(report, "thinned_m"), 0.0);
  EXPECT_GT(metric(report, "distance_m"), 49.9);
  EXPECT_NEAR(slam.beliefs[10].sigma_y_m, 0.2, 1e-12);
  EXPECT_NEAR(slam.beliefs[35].pose.position.y - report.track[35].pose.position.y, 0.0035, 1e-12);
  EXPECT_TRUE(slam.beliefs[70].corrected);
  EXPECT_FALSE(slam.beliefs[71].corrected);
  for (const Vec2 corner :
       {slam.landmarks[0].position, *slam.landmarks[0].truth, report.track.back().pose.position})
    EXPECT_TRUE(corner.x > report.bounds.low.x && corner.x < report.bounds.high.x &&
                corner.y > report.bounds.low.y && corner.y < report.bounds.high.y);
}

TEST(SlamRecord, ALongLogIsThinnedWithoutALieBetweenItsRows) {
  const Report whole = recorded(5000), thin = recorded(9000);
  EXPECT_EQ(whole.track.size(), 5000U);
  EXPECT_LE(thin.track.size(), 5000U);
  EXPECT_GT(thin.track.size(), 500U);
  ASSERT_EQ(thin.slam->beliefs.size(), thin.track.size());
  ASSERT_EQ(thin.slam->reference.size(), thin.track.size());
  EXPECT_LE(thin.slam->scans.size(), 400U);
  EXPECT_GT(thin.slam->scans.size(), 200U);
  const double within = metric(thin, "thinned_m");
  EXPECT_LT(within, 0.02);
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

TEST(SlamRecord, ReadBackItIsTheSame) {
  Report report = recorded(300);
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
  const std::string picture = to_animated_svg(*again, 12.0);
  for (const char* part : {"way as settled", "odometry alone", "reference", "loops closed", "landmarks"})
    EXPECT_NE(picture.find(part), std::string::npos) << part;
  EXPECT_TRUE(picture.ends_with("</svg>\n"));
}

TEST(SlamRecord, LoopsBeyondTheBoundGoEquallyFarApart) {
  std::vector<ReportLoop> loops(5000);
  for (std::size_t i = 0; i < loops.size(); ++i) loops[i].time_s = static_cast<double>(i);
  bound_loops(loops);
  ASSERT_EQ(loops.size(), 2000U);
  for (std::size_t i = 1; i < loops.size(); ++i) {
    const double apart_s = loops[i].time_s - loops[i - 1].time_s;
    EXPECT_TRUE(apart_s == 2.0 || apart_s == 3.0);
  }
}

}  // namespace
}  // namespace outrider
