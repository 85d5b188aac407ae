#include "outrider/jobs/slam/laser/laser_mission.hpp"

#include "outrider/core/units.hpp"

namespace outrider {

std::optional<Command> LaserMission::step(const Observation& seen) {
  newest.reset();
  if (!seen.scan) return std::nullopt;
  const Pose2 before = std::exchange(odometry, seen.odometry).value_or(seen.odometry);
  const Pose2 motion = seen.motion.value_or(wrap_heading(relative_pose(before, seen.odometry)));
  auto advanced = slam.advance(motion, *seen.scan);
  if (!advanced) {
    fault = std::move(advanced.error());
    return std::nullopt;
  }
  ++scans;
  repeated += repeats_.repeats(*seen.scan, seen.odometry) ? 1 : 0;
  matched += advanced->matched ? 1 : 0;
  lost += advanced->lost ? 1 : 0;
  newest = std::move(*advanced);
  return Wait{};
}

}  // namespace outrider
