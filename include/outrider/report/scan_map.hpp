// ScanMap: the occupancy map of the keyframe scans of a log, and when each of its cells first became known.
//
// add() draws a scan at its believed pose. After the poses have changed, redraw() draws all scans again; then
// a cell is known from the time of the first scan that sees it from its new pose. The map equals that of
// LaserSlam if the scans, the poses and their order are equal. Thread rule: one at a time.
#pragma once

#include <vector>

#include "outrider/report/discovery.hpp"
#include "outrider/slam/occupancy_map.hpp"

namespace outrider {

class ScanMap {
 public:
  ScanMap(const OccupancyMapOptions& options, const Pose2& robot_T_laser)
      : options_(options), robot_T_laser_(robot_T_laser), map_(options) {}

  /// Adds a scan. `pose_number` is the index of its pose in the argument of redraw(). The scan must outlive
  /// the map.
  void add(const Pose2& world_T_robot, const LaserScan& scan, double time_s, std::size_t pose_number);
  /// Draws all scans again at these poses. O(cells that all scans cross).
  void redraw(const std::vector<Pose2>& poses);

  /// Returns the map.
  [[nodiscard]] const OccupancyMap& map() const { return map_; }
  /// Returns the map as a report keeps it; see Discovery::map().
  [[nodiscard]] ReportMap drawn(std::size_t most_cells) const {
    return discovery_.map(map_.occupancy(), most_cells);
  }

 private:
  struct Kept {
    const LaserScan* scan = nullptr;
    double time_s = 0.0;
    std::size_t pose_number = 0;
  };
  void insert(const Pose2& world_T_robot, const Kept& kept);

  OccupancyMapOptions options_;
  Pose2 robot_T_laser_;
  OccupancyMap map_;
  Discovery discovery_;
  std::vector<Kept> kept_;
};

}  // namespace outrider
