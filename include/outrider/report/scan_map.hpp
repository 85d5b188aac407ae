// ScanMap: the map of the scans that were kept of a log, and when each of its cells was first known.
//
// Scans go in where they were believed to be. When their places have changed, redraw() draws all of them
// anew: then a cell is known from the time of the first scan that sees it from where it lies now. The map is
// that of LaserSlam when the scans, the poses and their order are. Thread rule: one at a time.
#pragma once

#include <vector>

#include "outrider/report/discovery.hpp"
#include "outrider/slam/occupancy_map.hpp"

namespace outrider {

class ScanMap {
 public:
  ScanMap(const OccupancyMapOptions& options, const Pose2& robot_T_laser)
      : options_(options), robot_T_laser_(robot_T_laser), map_(options) {}

  /// `pose_number`: of the pose at which it was taken, in what redraw() gets. The scan must stay where it is.
  void add(const Pose2& world_T_robot, const LaserScan& scan, double time_s, std::size_t pose_number);
  /// O(cells that all scans cross).
  void redraw(const std::vector<Pose2>& poses);

  [[nodiscard]] const OccupancyMap& map() const { return map_; }
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
