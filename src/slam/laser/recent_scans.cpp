#include "laser/recent_scans.hpp"

#include <algorithm>
#include <cmath>

#include "scan/scan_match.hpp"

namespace outrider {
namespace {

constexpr std::size_t most_scans = 12, least_scans = 4;
constexpr double kept_every_m = 0.25, kept_every_rad = 0.35;

}  // namespace

void RecentScans::move(const Pose2& motion) {
  pose_ = wrap_heading(compose(pose_, motion));
  unmatched_ += motion;
}

bool RecentScans::add(const LaserScan& scan, const Surface& surface) {
  if (map_) {
    const auto nothing_known = [](const Pose2&) { return 0.0; };
    const auto fit =
        match_nearby(*map_, surface, odometry_window(pose_, unmatched_, options_), nothing_known);
    if (!fit) {
      clear();
    } else {
      pose_ = wrap_heading(fit->pose);
      unmatched_ = {};
      const Pose2 since = wrap_heading(relative_pose(scans_.back().pose, pose_));
      if (norm(since.position) < kept_every_m && std::abs(since.heading_rad) < kept_every_rad) return false;
    }
  }
  keep(scan, surface);
  return true;
}

void RecentScans::keep(const LaserScan& scan, const Surface& surface) {
  scans_.push_back({scan, surface, pose_});
  if (scans_.size() > most_scans) scans_.pop_front();
  std::vector<SurfaceMap::Part> parts;
  for (const Placed& placed : scans_) parts.push_back({&placed.surface, placed.pose, 0});
  map_.emplace(parts);
}

void RecentScans::clear() {
  scans_.clear();
  map_.reset();
  pose_ = {};
  unmatched_ = {};
}

bool RecentScans::are_enough() const { return scans_.size() >= least_scans; }

Surface RecentScans::together() const {
  Surface result;
  for (const Placed& placed : scans_) {
    const Pose2 robot_T_scan = relative_pose(pose_, placed.pose);
    for (const SurfacePoint& p : placed.surface)
      result.push_back({robot_T_scan * p.position, rotated(robot_T_scan.heading_rad, p.normal)});
  }
  return result;
}

}  // namespace outrider
