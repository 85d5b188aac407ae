#include "outrider/jobs/slam/laser/localise_mission.hpp"

#include <utility>

#include "outrider/core/units.hpp"

namespace outrider {

std::optional<Command> LocaliseMission::step(const Observation& seen) {
  newest.reset();
  if (!seen.scan) return std::nullopt;
  const Pose2 before = std::exchange(odometry, seen.odometry).value_or(seen.odometry);
  const Pose2 motion = seen.motion.value_or(wrap_heading(relative_pose(before, seen.odometry)));
  auto advanced = localiser.advance(motion, *seen.scan);
  if (!advanced) {
    fault = std::move(advanced.error());
    return std::nullopt;
  }
  newest = *advanced;
  found += newest->found ? 1 : 0;
  keep_pose();
  if (newest->located) check_scan(*seen.scan);
  ++scans;
  return Wait{};
}

/// Keeps the pose of a located robot, and withdraws those that turned out to be wrong.
void LocaliseMission::keep_pose() {
  if (newest->located) {
    located.push_back(scans);
    poses.push_back(newest->pose);
  }
  if (newest->fits) fitting_ = poses.size();
  if (!newest->lost) return;
  located.resize(fitting_);
  poses.resize(fitting_);
}

/// Compares a scan with the map, by ranges and cells only, so that the check does not depend on the matching.
void LocaliseMission::check_scan(const LaserScan& scan) {
  constexpr double every_m = 0.25, least_share = 0.5, most_contradiction = 0.25;
  constexpr std::size_t least_beams = 20;
  const Pose2& pose = newest->pose;
  if (checked_at_ && distance(*checked_at_, pose.position) < every_m) return;
  checked_at_ = pose.position;
  if (!check(scan)) return;
  const MapFit fit = map_fit(localiser.map().occupancy,
                             compose(relative_pose(localiser.world_T_grid(), pose), options.robot_T_laser),
                             scan, options.reach_m);
  if (fit.beams() < least_beams) return;
  ++checked;
  if (fit.share() < least_share || fit.contradiction() > most_contradiction) ++contradicted;
}

}  // namespace outrider
