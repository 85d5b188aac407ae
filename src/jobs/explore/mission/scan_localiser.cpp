#include "outrider/jobs/explore/mission/scan_localiser.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "outrider/jobs/explore/map/map_doubt.hpp"
#include "outrider/slam/scan/scan_contradiction.hpp"

namespace outrider {
namespace {

constexpr double near_m = 1.8;         ///< ends of beams within that are kept
constexpr std::size_t most_gaps = 24;  ///< between parts of the map that odometry alone joins
constexpr double remembered_s = 10.0;  ///< of odometry; scans that come later than that are taken for new

/// Returns true if the scan is usable.
bool usable(const LaserScan& scan) {
  return check(scan) &&
         std::ranges::any_of(scan.ranges_m, [&](float range) { return range >= scan.least_m; });
}

/// Returns the end points of the beams that hit something near.
std::vector<Vec2> ends_of(const LaserScan& scan, const Pose2& frame_T_laser) {
  std::vector<Vec2> ends;
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    const auto range_m = static_cast<double>(scan.ranges_m[i]);
    if (!(range_m >= scan.least_m && range_m <= std::min(scan.most_m, near_m))) continue;
    const double bearing =
        frame_T_laser.heading_rad + scan.first_rad + static_cast<double>(i) * scan.step_rad;
    ends.push_back(frame_T_laser.position + range_m * direction(bearing));
  }
  return ends;
}

}  // namespace

ScanLocaliser::ScanLocaliser(LaserSlam slam, const LaserSlamOptions& options, const Pose2& start,
                             double lost_m)
    : slam_(std::move(slam)),
      robot_T_laser_(options.robot_T_laser),
      much_m_(2.0 * options.map.resolution_m),
      lost_m_(lost_m),
      pose_(start) {}

void ScanLocaliser::remember_odometry() {
  odometries_.push_back({time_s_, odometry_});
  while (odometries_.front().time_s < time_s_ - remembered_s) odometries_.pop_front();
}

/// Returns the odometry at a time, between the observations around it; the newest for a time that is not in
/// memory.
Pose2 ScanLocaliser::odometry_at(double time_s) const {
  const auto after = std::ranges::lower_bound(odometries_, time_s, {}, &TimedOdometry::time_s);
  if (after == odometries_.end() || (after == odometries_.begin() && after->time_s > time_s))
    return odometry_;
  if (after->time_s == time_s || after == odometries_.begin()) return after->odometry;
  const TimedOdometry& before = *std::prev(after);
  const double part = (time_s - before.time_s) / (after->time_s - before.time_s);
  const Pose2 motion = wrap_heading(relative_pose(before.odometry, after->odometry));
  return compose(before.odometry, {part * motion.position, part * motion.heading_rad});
}

Pose2 ScanLocaliser::carried_on() const {
  return compose(slam_.pose(), wrap_heading(relative_pose(odometry_of_slam_, odometry_)));
}

bool ScanLocaliser::much_between(const Pose2& before, const Pose2& after) const {
  return distance(before.position, after.position) > much_m_;
}

/// Keeps what changed on the map; after two scans without a look at it, all of it is compared.
void ScanLocaliser::learn(MapUpdate update) {
  if (has_news_) update = {true, {}};
  changed_ = std::move(update);
  has_news_ = true;
}

void ScanLocaliser::settle(Localised& result) {
  const Pose2 before = slam_.pose();
  slam_.settle();
  result.corrected = result.corrected || much_between(before, slam_.pose());
  result.redrawn = true;
  settles_soon_ = false;
  settled_m_ = driven_m_;
  learn({true, {}});
}

/// Keeps a usable scan that was measured at the odometry `then`.
void ScanLocaliser::keep(const LaserScan& scan, const Pose2& then) {
  scan_s_ = std::min(scan.time_s, time_s_);
  range_m_ = scan.most_m;
  newest_ = {scan, static_cast<std::size_t>(scans_)};
  if (!first_) first_ = newest_;
  close_range_.add(then, ends_of(scan, robot_T_laser_));
}

void ScanLocaliser::take_scan(const LaserScan& scan, Localised& result) {
  if (settles_soon_) settle(result);
  const Pose2 then = odometry_at(scan.time_s);
  const Pose2 motion = relative_pose(odometry_of_slam_, then);
  const Pose2 believed = compose(slam_.pose(), motion);
  auto step = slam_.advance(wrap_heading(motion), scan);
  if (!step) {
    result.lost = step.error().sentence;
    return;
  }
  if (step->update.redrawn) result.corrected = result.corrected || much_between(believed, step->pose);
  odometry_of_slam_ = then;
  pose_ = compose(step->pose, wrap_heading(relative_pose(then, odometry_)));
  result.redrawn = result.redrawn || step->update.redrawn;
  ++scans_;
  if (!usable(scan) || repeated_.repeats(scan, odometry_of_slam_))
    ++bad_scans_;
  else
    keep(scan, then);
  learn(std::move(step->update));
  result.closed_loop = step->closed_loop;
  result.undid_loop = step->undid_loop;
  if (step->kept && !step->matched && slam_.gaps().size() > most_gaps)
    result.lost = fmt::format("it is lost: its map has more than {} gaps that no scan spans", most_gaps);
  const Eigen::Matrix3d p = slam_.pose_covariance();
  const double sigma_m = std::sqrt(std::max(p(0, 0), p(1, 1)));
  if (sigma_m > lost_m_)
    result.lost = fmt::format("it is lost: its position has a standard deviation of {:.2f} m", sigma_m);
}

Localised ScanLocaliser::note(const Observation& seen) {
  const Pose2 now = finite(seen.odometry) ? seen.odometry : odometry_;
  if (!started_s_) {
    started_s_ = scan_s_ = time_s_ = seen.time_s;
    odometry_ = odometry_of_slam_ = now;
    world_T_odometry_ = compose(pose_, inverse(now));
  }
  const double passed_s = seen.time_s - time_s_;
  const Pose2 motion = wrap_heading(relative_pose(odometry_, now));
  if (passed_s > 0.0) twist_ = twist_between({}, motion, passed_s);
  time_s_ = seen.time_s;
  driven_m_ += norm(motion.position);
  odometry_ = now;
  remember_odometry();
  pose_ = carried_on();
  Localised result;
  if (seen.scan) take_scan(*seen.scan, result);
  moved_ = moved_ || result.corrected || result.closed_loop;
  return result;
}

bool ScanLocaliser::take(const LaserScan&, const Pose2&) {
  world_T_odometry_ = wrap_heading(compose(pose_, inverse(odometry_)));
  return std::exchange(moved_, false);
}

void ScanLocaliser::finish() {
  slam_.settle();
  pose_ = carried_on();
}

std::string ScanLocaliser::doubt_of_range_finder() {
  if (scans_ < asked_at_) return {};
  asked_at_ += asked_at_ / 4;
  return range_finder_doubt(slam_);
}

std::optional<double> ScanLocaliser::contradiction_of_first_scan() const {
  if (!first_) return std::nullopt;
  const std::vector<Pose2> came = slam_.trajectory();
  const auto laser_at = [&](std::size_t step) {
    return compose(came[std::min(step, came.size() - 1)], robot_T_laser_);
  };
  return contradiction(first_->scan, laser_at(first_->step), newest_->scan, laser_at(newest_->step));
}

}  // namespace outrider
