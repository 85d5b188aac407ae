// LaserMission: mapping with a laser on a robot that somebody else drives.
//
// LaserSlam processes each scan with the odometry since the previous scan. The mission only commands to wait.
// It ends with the first observation without a scan, or when a scan is refused.
#pragma once

#include <optional>

#include "outrider/robot/mission.hpp"
#include "outrider/slam/laser/laser_slam.hpp"
#include "outrider/slam/scan/repeated_scans.hpp"

namespace outrider {

/// The state of the execution.
struct LaserMission {
  explicit LaserMission(LaserSlam mapping) : slam(std::move(mapping)) {}

  /// Returns a command to wait, or nothing if the mission is over.
  std::optional<Command> step(const Observation& seen);

  LaserSlam slam;
  std::optional<Pose2> odometry;        ///< odometry of the previous scan
  std::optional<LaserSlamStep> newest;  ///< SLAM result of this step
  std::size_t scans = 0;                ///< number of scans
  std::size_t matched = 0;              ///< number of scans that SLAM matched
  std::size_t lost = 0;                 ///< number of scans at which the robot was lost
  std::size_t repeated = 0;             ///< number of scans that only repeat ranges, as of a frozen laser
  std::optional<Fault> fault;           ///< why a scan was refused

 private:
  RepeatedScans repeats_;
};

}  // namespace outrider
