// ScanMap: the occupancy map of the scans of a recording, logged while it grows.
//
// add() draws a scan at its believed pose. Loops move the poses later, so finish() logs the final map of the
// mapper. It holds no scans. Thread rule: one at a time.
#pragma once

#include "outrider/job/map_log.hpp"
#include "outrider/slam/map/occupancy_map.hpp"

namespace outrider {

class ScanMap {
 public:
  /// The map is logged once in `period_s`.
  ScanMap(const OccupancyMapOptions& options, const Pose2& robot_T_laser, double period_s)
      : robot_T_laser_(robot_T_laser), map_(options), logged_(period_s) {}

  /// Adds a scan.
  void add(Log& log, const Pose2& world_T_robot, const LaserScan& scan, double time_s);
  /// Logs the final map.
  void finish(Log& log, const Grid<std::uint8_t>& occupancy, double time_s);

 private:
  Pose2 robot_T_laser_;
  OccupancyMap map_;
  MapLog logged_;
};

}  // namespace outrider
