#include "outrider/report/growth.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace outrider {
namespace {

/// The items after the first `told`, which are told with that.
template <class T>
std::vector<T> rest_of(const std::vector<T>& items, std::size_t& told) {
  const std::size_t begin = std::min(std::exchange(told, items.size()), items.size());
  return {items.begin() + static_cast<std::ptrdiff_t>(begin), items.end()};
}

/// Returns the static parts of the report: everything except the lists that grow.
PageReport scene_of(const PageReport& report) {
  PageReport scene = report;
  scene.reason.clear();
  scene.metrics.clear();
  scene.targets.clear();
  scene.paths.clear();
  scene.shots.clear();
  scene.events.clear();
  scene.track.clear();
  if (scene.supplies) scene.supplies->levels.clear();
  if (auto& pursuit = scene.pursuit) {
    pursuit->target.clear();
    pursuit->robots.clear();
    pursuit->paid.clear();
    pursuit->bounds.clear();
  }
  if (auto& drive = scene.drive) {
    drive->stops.clear();
    drive->beliefs.clear();
  }
  if (auto& explore = scene.explore) {
    explore->map = {};
    explore->beliefs.clear();
    explore->decisions.clear();
  }
  if (auto& slam = scene.slam) {
    const std::string engine = slam->engine;
    slam.emplace().engine = engine;
  }
  return scene;
}

bool same(const ReportMap& a, const ReportMap& b) {
  return a.origin == b.origin && a.cell_m == b.cell_m && a.columns == b.columns && a.rows == b.rows &&
         a.step_s == b.step_s && a.state_runs == b.state_runs && a.known_runs == b.known_runs;
}

/// Returns the part of the report, which it creates if there is none yet.
template <class Part>
Part& part_of(std::optional<Part>& part) {
  return part ? *part : part.emplace();
}

}  // namespace

PageReport ReportGrowth::delta(const PageReport& so_far) {
  const bool begins = std::exchange(job_, so_far.job) != so_far.job;
  PageReport changes = begins ? scene_of(so_far) : PageReport{};
  changes.status = "running";
  changes.paths = rest_of(so_far.paths, sent_.paths);
  changes.shots = rest_of(so_far.shots, sent_.shots);
  changes.events = rest_of(so_far.events, sent_.events);
  changes.track = rest_of(so_far.track, sent_.track);
  std::vector<TargetState> targets;
  for (const ReportTarget& one : so_far.targets) {
    targets.emplace_back(one.name, one.status, one.shots, one.moves ? one.moves->size() : 0);
  }
  if (targets != targets_) changes.targets = so_far.targets;
  targets_ = std::move(targets);
  if (so_far.supplies) part_of(changes.supplies).levels = rest_of(so_far.supplies->levels, sent_.levels);
  if (so_far.pursuit) add_pursuit(changes, *so_far.pursuit);
  if (so_far.drive) add_drive(changes, *so_far.drive);
  if (so_far.explore) add_explore(changes, *so_far.explore);
  if (so_far.slam) add_slam(changes, *so_far.slam);
  return changes;
}

void ReportGrowth::add_pursuit(PageReport& changes, const ReportPursuit& pursuit) {
  ReportPursuit& part = part_of(changes.pursuit);
  part.target = rest_of(pursuit.target, sent_.target);
  part.paid = rest_of(pursuit.paid, sent_.paid);
  part.bounds = rest_of(pursuit.bounds, sent_.bounds);
  sent_.robots.resize(pursuit.robots.size(), 0);
  for (std::size_t i = 0; i < pursuit.robots.size(); ++i)
    part.robots.push_back(rest_of(pursuit.robots[i], sent_.robots[i]));
}

void ReportGrowth::add_drive(PageReport& changes, const ReportDrive& drive) {
  ReportDrive& part = part_of(changes.drive);
  part.beliefs = rest_of(drive.beliefs, sent_.drive_beliefs);
  std::vector<double> arrivals;
  for (const ReportStop& stop : drive.stops) arrivals.push_back(std::isnan(stop.time_s) ? -1.0 : stop.time_s);
  if (arrivals != arrivals_) part.stops = drive.stops;
  arrivals_ = std::move(arrivals);
}

void ReportGrowth::add_explore(PageReport& changes, const ReportExplore& explore) {
  ReportExplore& part = part_of(changes.explore);
  part.beliefs = rest_of(explore.beliefs, sent_.beliefs);
  part.decisions = rest_of(explore.decisions, sent_.decisions);
  if (!same(explore.map, map_)) part.map = map_ = explore.map;
}

void ReportGrowth::add_slam(PageReport& changes, const ReportSlam& slam) {
  ReportSlam& part = part_of(changes.slam);
  part.engine = slam.engine;
  part.beliefs = rest_of(slam.beliefs, sent_.slam_beliefs);
  part.odometry = rest_of(slam.odometry, sent_.odometry);
  part.reference = rest_of(slam.reference, sent_.reference);
  part.scans = rest_of(slam.scans, sent_.scans);
  part.loops = slam.loops;
  part.landmarks = slam.landmarks;
  if (slam.map && !same(*slam.map, slam_map_)) part.map = slam_map_ = *slam.map;
}

}  // namespace outrider
