// LocaliseMission: localisation on a known map, on a robot that somebody else drives.
//
// MapLocaliser processes each scan with the odometry since the previous scan. The mission only commands to
// wait. It ends with the first observation without a scan, or when a scan is refused. It takes some scans to
// notice that the robot was carried away: the poses since the last scan that fitted are then withdrawn.
#pragma once

#include <optional>
#include <vector>

#include "outrider/robot/mission.hpp"
#include "outrider/slam/map/map_fit.hpp"
#include "outrider/slam/map/map_localiser.hpp"

namespace outrider {

struct LocaliseMission {
  LocaliseMission(MapLocaliser begun, const LaserSlamOptions& chosen)
      : localiser(std::move(begun)), options(chosen) {}

  /// Returns a command to wait, or nothing if the mission is over.
  std::optional<Command> step(const Observation& seen);

  MapLocaliser localiser;
  LaserSlamOptions options;
  std::optional<Pose2> odometry;           ///< odometry of the previous scan
  std::optional<MapLocaliserStep> newest;  ///< result of this step
  std::vector<std::size_t> located;        ///< numbers of the scans at which the robot was located, rising
  std::vector<Pose2> poses;                ///< world_T_robot at each of these
  std::size_t scans = 0;                   ///< number of scans
  std::size_t found = 0;                   ///< times that the robot was recognised
  std::size_t checked = 0;       ///< scans that were compared with the map, one after each 0.25 m of the path
  std::size_t contradicted = 0;  ///< of these, those that do not fit it
  std::optional<Fault> fault;    ///< why a scan was refused

 private:
  void keep_pose();
  void check_scan(const LaserScan& scan);

  std::size_t fitting_ = 0;  ///< poses up to the last scan that fitted
  std::optional<Vec2> checked_at_;
};

}  // namespace outrider
