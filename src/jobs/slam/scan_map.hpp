// ScanMap: the occupancy map of the scans of a recording, logged while it grows.
//
// add() draws a scan at its believed pose. After loops have moved the poses, finish() draws all scans again
// at the settled poses; with final poses, none is kept. The map equals that of LaserSlam if the scans, the
// poses and their order are equal. Thread rule: one at a time.
#pragma once

#include <vector>

#include "outrider/job/map_log.hpp"
#include "outrider/slam/occupancy_map.hpp"

namespace outrider {

class ScanMap {
 public:
  /// With `final_poses`, the poses of add() are those of finish(). The map is logged once in `period_s`.
  ScanMap(const OccupancyMapOptions& options, const Pose2& robot_T_laser, bool final_poses, double period_s)
      : options_(options),
        robot_T_laser_(robot_T_laser),
        final_poses_(final_poses),
        map_(options),
        logged_(period_s) {}

  /// Adds a scan. `pose_number` is the index of its pose in the argument of finish().
  void add(Log& log, const Pose2& world_T_robot, const LaserScan& scan, double time_s,
           std::size_t pose_number);
  /// Draws all scans again at these poses, and logs the map. O(cells that all scans cross).
  void finish(Log& log, const std::vector<Pose2>& poses, double time_s);

  /// Returns the map.
  [[nodiscard]] const OccupancyMap& map() const { return map_; }

 private:
  struct Kept {
    LaserScan scan;
    std::size_t pose_number = 0;
  };
  MapUpdate insert(const Pose2& world_T_robot, const LaserScan& scan);

  OccupancyMapOptions options_;
  Pose2 robot_T_laser_;
  bool final_poses_;
  OccupancyMap map_;
  MapLog logged_;
  std::vector<Kept> kept_;
};

}  // namespace outrider
