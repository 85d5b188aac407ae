#include "outrider/report/slam_record.hpp"

#include <algorithm>
#include <cmath>

#include "outrider/core/units.hpp"
#include "outrider/report/thinning.hpp"

namespace outrider {
namespace {

constexpr double step_s = 0.1;
constexpr double least_gone_on = 0.9;  // of the steps of a log whose times are taken
constexpr std::size_t most_rows = 5000;
constexpr double least_thinning_m = 1e-3;
constexpr double most_scans = 400.0;
constexpr double least_scan_way_m = 0.2;
constexpr std::size_t most_points = 180;
constexpr std::size_t most_loops = 2000;
constexpr double lever_m = 0.5;  // of a turn that brings other things into view

double centimetres(double value_m) { return std::round(100.0 * value_m) / 100.0; }

/// The elements with these numbers.
template <class T>
void keep(std::vector<T>& items, const std::vector<std::size_t>& rows) {
  if (items.empty()) return;
  std::vector<T> kept;
  kept.reserve(rows.size());
  for (const std::size_t row : rows) kept.push_back(items[row]);
  items = std::move(kept);
}

void add_heading(std::vector<double>& column, double heading_rad) {
  const double before = column.empty() ? heading_rad : column.back();
  column.push_back(before + wrap_angle(heading_rad - before));
}

/// All values that are interpolated linearly between two rows.
std::vector<std::vector<double>> columns_of(const Report& report) {
  const ReportSlam& slam = *report.slam;
  std::vector<std::vector<double>> columns(8);
  for (const TrackSample& sample : report.track) {
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
    if (places->empty()) continue;
    for (const bool across : {false, true}) {
      std::vector<double>& column = columns.emplace_back();
      for (const Vec2 place : *places) column.push_back(across ? place.y : place.x);
    }
  }
  return columns;
}

}  // namespace

std::vector<double> run_times(const std::vector<double>& recorded_s) {
  std::vector<double> times;
  if (recorded_s.empty()) return times;
  double latest_s = recorded_s.front();
  std::size_t gone_on = 0;
  for (const double time_s : recorded_s) {
    gone_on += time_s > latest_s ? 1 : 0;
    latest_s = std::max(latest_s, time_s);
    times.push_back(latest_s - recorded_s.front());
  }
  const double steps = static_cast<double>(times.size() - 1);
  if (std::isfinite(times.back()) && static_cast<double>(gone_on) >= least_gone_on * steps) return times;
  for (std::size_t i = 0; i < times.size(); ++i) times[i] = step_s * static_cast<double>(i);
  return times;
}

std::vector<Vec2> points_of(const LaserScan& scan, const Pose2& robot_T_laser) {
  std::vector<Vec2> points;
  const std::size_t beams = scan.ranges_m.size();
  const std::size_t every = std::max<std::size_t>(1, (beams + most_points - 1) / most_points);
  for (std::size_t i = 0; i < beams; i += every) {
    const double range_m = scan.ranges_m[i];
    if (!(range_m >= scan.least_m && range_m <= scan.most_m)) continue;
    const double bearing_rad = scan.first_rad + scan.step_rad * static_cast<double>(i);
    points.push_back(robot_T_laser * (range_m * direction(bearing_rad)));
  }
  return points;
}

ReportSigmas sigmas_of(double xx, double xy, double yy) {
  const double x_m = std::sqrt(std::max(0.0, xx)), y_m = std::sqrt(std::max(0.0, yy));
  return {x_m, y_m, x_m * y_m > 0.0 ? std::clamp(xy / (x_m * y_m), -1.0, 1.0) : 0.0};
}

double scan_way_m(const Pose2& motion) {
  return norm(motion.position) + lever_m * std::abs(motion.heading_rad);
}

SlamRecord::SlamRecord(Report& report, const std::string& engine, double way_m)
    : report_(report), scan_every_m_(std::max(least_scan_way_m, way_m / most_scans)) {
  report_.slam.emplace().engine = engine;
}

void SlamRecord::note(const SlamRow& row) {
  ReportSlam& slam = *report_.slam;
  if (odometry_) {
    way_m_ += scan_way_m({row.odometry.position - odometry_->position,
                          wrap_angle(row.odometry.heading_rad - odometry_->heading_rad)});
  }
  odometry_ = row.odometry;
  const Eigen::Matrix3d& c = row.covariance;
  const ReportSigmas sigmas = sigmas_of(c(0, 0), c(0, 1), c(1, 1));
  slam.beliefs.push_back({row.time_s, row.pose, sigmas.x_m, sigmas.y_m, sigmas.correlation,
                          std::sqrt(std::max(0.0, c(2, 2))), row.recognised});
  slam.odometry.push_back(row.odometry.position);
  report_.track.push_back({row.time_s, row.pose, 0.0, 0.0});
}

void SlamRecord::note_scan(const std::function<std::vector<Vec2>()>& points) {
  if (way_m_ < next_scan_m_) return;
  std::vector<Vec2> seen = points();
  if (seen.empty()) return;
  next_scan_m_ = way_m_ + scan_every_m_;
  for (Vec2& point : seen) point = {centimetres(point.x), centimetres(point.y)};
  report_.slam->scans.push_back({report_.track.back().time_s, std::move(seen)});
}

void SlamRecord::settle(const std::vector<Pose2>& poses, const std::vector<Vec2>& reference) {
  double way_m = 0.0;
  for (std::size_t i = 0; i < report_.track.size() && i < poses.size(); ++i) {
    report_.track[i].pose = poses[i];
    if (i > 0) way_m += distance(poses[i - 1].position, poses[i].position);
  }
  report_.metrics.emplace_back("distance_m", way_m);
  report_.slam->reference = reference;
  thin();
  bound_loops(report_.slam->loops);
}

void SlamRecord::thin() {
  std::vector<double> time;
  for (const TrackSample& sample : report_.track) time.push_back(sample.time_s);
  const Thinning kept = thinned(time, columns_of(report_), most_rows, least_thinning_m);
  report_.metrics.emplace_back("thinned_m", kept.within);
  if (kept.rows.size() == time.size()) return;
  ReportSlam& slam = *report_.slam;
  for (std::size_t i = 1; i < kept.rows.size(); ++i) {  // since the belief before
    for (std::size_t row = kept.rows[i - 1] + 1; row < kept.rows[i]; ++row)
      slam.beliefs[kept.rows[i]].corrected |= slam.beliefs[row].corrected;
  }
  keep(report_.track, kept.rows);
  keep(slam.beliefs, kept.rows);
  keep(slam.odometry, kept.rows);
  keep(slam.reference, kept.rows);
}

void bound_loops(std::vector<ReportLoop>& loops) {
  if (loops.size() <= most_loops) return;
  std::vector<ReportLoop> kept;
  for (std::size_t i = 0; i < most_loops; ++i) kept.push_back(loops[i * loops.size() / most_loops]);
  loops = std::move(kept);
}

Box2 bounds_of(const Report& report) {
  Box2 box;
  for (const TrackSample& sample : report.track) box.include(sample.pose.position);
  for (const ReportPath& path : report.paths) {
    for (const Vec2 place : path.waypoints) box.include(place);
  }
  if (report.slam) {
    for (const Vec2 place : report.slam->reference) box.include(place);
    for (const ReportLandmark& landmark : report.slam->landmarks) {
      box.include(landmark.position);
      if (landmark.truth) box.include(*landmark.truth);
    }
    if (const auto& map = report.slam->map; map && map->columns > 0) {
      box.include(map->origin);
      box.include(map->origin + map->cell_m * Vec2{1.0 * map->columns, 1.0 * map->rows});
    }
  }
  return box.empty() ? box : box.grown(0.5 + 0.01 * norm(box.size()));
}

}  // namespace outrider
