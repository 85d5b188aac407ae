#include "page_slam.hpp"

#include <algorithm>
#include <cmath>

#include "outrider/core/units.hpp"
#include "outrider/log/conversions.hpp"
#include "outrider/log/mapping_messages.hpp"
#include "outrider/log/ros_sensor_messages.hpp"
#include "outrider/log/topics.hpp"
#include "outrider/report/thinning.hpp"
#include "page_map.hpp"

namespace outrider {
namespace {

constexpr std::size_t most_rows = 5000;
constexpr double least_thinning_m = 1e-3;
constexpr std::size_t most_scans = 400;
constexpr std::size_t most_points = 180;
constexpr std::size_t most_loops = 2000;

double centimetres(double value_m) { return std::round(100.0 * value_m) / 100.0; }

std::vector<Vec2> places_of(const nav_msgs::Path* path) {
  std::vector<Vec2> places;
  if (path == nullptr) return places;
  for (const auto& pose : path->poses) places.push_back({pose.pose.position.x, pose.pose.position.y});
  return places;
}

std::vector<Vec2> points_of_scan(const sensor_msgs::LaserScan& scan, const Pose2& robot_T_laser) {
  std::vector<Vec2> points;
  const std::size_t every = std::max<std::size_t>(1, (scan.ranges.size() + most_points - 1) / most_points);
  for (std::size_t i = 0; i < scan.ranges.size(); i += every) {
    const float range_m = scan.ranges[i];
    if (!(range_m >= scan.range_min && range_m <= scan.range_max)) continue;
    const double bearing_rad = scan.angle_min + scan.angle_increment * static_cast<double>(i);
    const Vec2 at = robot_T_laser * (static_cast<double>(range_m) * direction(bearing_rad));
    points.push_back({centimetres(at.x), centimetres(at.y)});
  }
  return points;
}

/// Of a settled mapping at most 400 scans or sightings, at equal distances in their order; else every tenth.
void add_scans(ReportSlam& slam, const Log& log, bool settled) {
  const auto& scans = log.messages<sensor_msgs::LaserScan>(topic::scan);
  const auto& sightings = log.messages<outrider_msgs::Sightings>(topic::sightings);
  const auto laser = laser_of(log);
  const auto every = [&](std::size_t count) {
    return settled ? std::max<std::size_t>(1, (count + most_scans - 1) / most_scans) : 10;
  };
  for (std::size_t i = 0; i < scans.size(); i += every(scans.size())) {
    auto points = points_of_scan(scans[i].message, laser->mount);
    if (!points.empty()) slam.scans.push_back({scans[i].time_s(), std::move(points)});
  }
  for (std::size_t i = 0; i < sightings.size(); i += every(sightings.size())) {
    ReportScan& scan = slam.scans.emplace_back(ReportScan{sightings[i].time_s(), {}});
    for (const auto& point : sightings[i].message.points) {
      scan.points.push_back({centimetres(point.x), centimetres(point.y)});
    }
  }
}

template <class T>
void keep(std::vector<T>& items, const std::vector<std::size_t>& rows) {
  if (items.empty()) return;
  std::vector<T> kept;
  for (const std::size_t row : rows) kept.push_back(items[row]);
  items = std::move(kept);
}

void add_heading(std::vector<double>& column, double heading_rad) {
  const double before = column.empty() ? heading_rad : column.back();
  column.push_back(before + wrap_angle(heading_rad - before));
}

/// All values that are interpolated linearly between two rows.
std::vector<std::vector<double>> columns_of(const PageReport& page) {
  const ReportSlam& slam = *page.slam;
  std::vector<std::vector<double>> columns(8);
  for (const TrackSample& sample : page.track) {
    columns[0].push_back(sample.pose.position.x);
    columns[1].push_back(sample.pose.position.y);
    add_heading(columns[2], sample.pose.heading_rad);
  }
  for (const ReportBelief& belief : slam.beliefs) {
    columns[3].push_back(belief.pose.position.x);
    columns[4].push_back(belief.pose.position.y);
    add_heading(columns[5], belief.pose.heading_rad);
    columns[6].push_back(belief.sigma_x_m);
    columns[7].push_back(belief.sigma_y_m);
  }
  for (const std::vector<Vec2>* places : {&slam.odometry, &slam.reference}) {
    if (places->size() != page.track.size()) continue;
    for (const bool across : {false, true}) {
      std::vector<double>& column = columns.emplace_back();
      for (const Vec2 place : *places) column.push_back(across ? place.y : place.x);
    }
  }
  return columns;
}

/// Keeps at most 5000 rows.
void thin(PageReport& page) {
  ReportSlam& slam = *page.slam;
  if (page.track.size() <= most_rows) return;
  std::vector<double> time;
  for (const TrackSample& sample : page.track) time.push_back(sample.time_s);
  const Thinning kept = thinned(time, columns_of(page), most_rows, least_thinning_m);
  for (std::size_t i = 1; i < kept.rows.size(); ++i) {  // since the belief before
    for (std::size_t row = kept.rows[i - 1] + 1; row < kept.rows[i]; ++row)
      slam.beliefs[kept.rows[i]].corrected |= slam.beliefs[row].corrected;
  }
  if (slam.odometry.size() == page.track.size()) keep(slam.odometry, kept.rows);
  if (slam.reference.size() == page.track.size()) keep(slam.reference, kept.rows);
  keep(slam.beliefs, kept.rows);
  keep(page.track, kept.rows);
}

void add_other_robots(PageReport& page, const Log& log) {
  page.paths.clear();
  const auto add = [&](const nav_msgs::Path* path) {
    if (path == nullptr || path->poses.empty()) return false;
    const double end_s = seconds(nanoseconds_of(path->poses.back().header.stamp));
    page.paths.push_back({0.0, end_s, places_of(path)});
    return true;
  };
  if (log.latest<nav_msgs::Path>("/robot_2/trajectory") == nullptr) return;
  add(log.latest<nav_msgs::Path>(topic::trajectory));
  for (int robot = 2; add(log.latest<nav_msgs::Path>("/robot_" + std::to_string(robot) + "/trajectory"));)
    ++robot;
}

}  // namespace

std::vector<ReportBelief> beliefs_of(const Log& log) {
  const auto& corrections = log.messages<geometry_msgs::PoseStamped>(topic::corrections);
  std::size_t correction = 0;
  std::vector<ReportBelief> beliefs;
  for (const auto& stamped : log.messages<geometry_msgs::PoseWithCovarianceStamped>(topic::belief)) {
    const auto& c = stamped.message.pose.covariance;
    const double x = std::sqrt(std::max(0.0, c[0])), y = std::sqrt(std::max(0.0, c[7]));
    const bool corrected =
        correction < corrections.size() && corrections[correction].time_ns == stamped.time_ns;
    if (corrected) ++correction;
    beliefs.push_back({stamped.time_s(), pose_of(stamped.message.pose.pose), x, y,
                       x * y > 0.0 ? std::clamp(c[1] / (x * y), -1.0, 1.0) : 0.0,
                       std::sqrt(std::max(0.0, c[35])), corrected});
  }
  return beliefs;
}

void add_slam(PageReport& page, const Log& log) {
  const auto* info = log.latest<outrider_msgs::RunInfo>(topic::run);
  if (info == nullptr || info->engine.empty()) return;
  ReportSlam& slam = page.slam.emplace();
  slam.engine = info->engine;
  slam.beliefs = beliefs_of(log);
  for (const auto& one : log.messages<nav_msgs::Odometry>(topic::odometry)) {
    const auto& at = one.message.pose.pose.position;
    slam.odometry.push_back({at.x, at.y});
  }
  slam.reference = places_of(log.latest<nav_msgs::Path>(topic::reference));
  page.track.clear();
  const auto* settled = log.latest<nav_msgs::Path>(topic::trajectory);
  for (std::size_t i = 0; i < slam.beliefs.size(); ++i) {
    const bool known = settled != nullptr && i < settled->poses.size();
    page.track.push_back(
        {slam.beliefs[i].time_s, known ? pose_of(settled->poses[i].pose) : slam.beliefs[i].pose});
  }
  if (!page.track.empty()) page.start = page.track.front().pose;
  if (const auto* loops = log.latest<outrider_msgs::Loops>(topic::loops)) {
    const std::size_t count = loops->loops.size(), kept = std::min(count, most_loops);
    for (std::size_t i = 0; i < kept; ++i) {
      const auto& loop = loops->loops[i * count / kept];
      slam.loops.push_back({loop.closed, vec2_of(loop.from), vec2_of(loop.to)});
    }
  }
  if (const auto* map = log.latest<outrider_msgs::Landmarks>(topic::landmarks)) {
    for (const auto& one : map->landmarks) {
      slam.landmarks.push_back({one.id,
                                one.first_seen,
                                vec2_of(one.position),
                                one.sigma_x,
                                one.sigma_y,
                                one.correlation,
                                static_cast<int>(one.sightings),
                                {}});
      if (std::isfinite(one.truth.x)) slam.landmarks.back().truth = vec2_of(one.truth);
    }
  }
  add_scans(slam, log, settled != nullptr);
  if (ReportMap map = page_map(log); map.columns > 0) slam.map = std::move(map);
  if (settled != nullptr) thin(page);
  add_other_robots(page, log);
}

}  // namespace outrider
