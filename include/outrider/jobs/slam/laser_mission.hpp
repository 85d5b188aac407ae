// LaserMission: mapping with a laser on a robot that somebody else drives.
//
// Each scan goes through LaserSlam, with the motion since the scan before by odometry. The mission gives no
// command but to wait, and ends with the first observation without a scan, or when a scan is refused.
#pragma once

#include <optional>

#include "outrider/robot/mission.hpp"
#include "outrider/slam/laser_slam.hpp"

namespace outrider {

struct LaserMission {
  explicit LaserMission(LaserSlam mapping) : slam(std::move(mapping)) {}

  std::optional<Command> step(const Observation& seen);

  LaserSlam slam;
  std::optional<Pose2> odometry;        ///< at the scan before
  std::optional<LaserSlamStep> newest;  ///< what SLAM made of the scan of this step
  std::size_t scans = 0;
  std::size_t matched = 0;     ///< of these
  std::size_t lost = 0;        ///< and of these
  std::optional<Fault> fault;  ///< of the scan that was refused
};

}  // namespace outrider
