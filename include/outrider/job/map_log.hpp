// MapLog: logs an occupancy map while it grows.
//
// The map is logged at most once a second of the run, or in another period. It is logged whole, as
// nav_msgs/OccupancyGrid, when its frame has changed or it was redrawn, and else as
// map_msgs/OccupancyGridUpdate: the smallest rectangle with all changes. A whole map replaces the updates up
// to its own time. Thread rule: one at a time.
#pragma once

#include <cstdint>
#include <span>

#include "outrider/log/log.hpp"
#include "outrider/world/grid.hpp"

namespace outrider {

/// Logs a whole map, which is turned by `yaw_rad` about its origin. `occupancy` holds values of Occupancy.
void log_map(Log& log, const Grid<std::uint8_t>& occupancy, double yaw_rad, double time_s);

class MapLog {
 public:
  /// The map is logged at most once in `period_s` of the run.
  explicit MapLog(double period_s = 1.0) : period_s_(period_s) {}

  /// Notes a change. `occupancy` holds values of Occupancy. Only the cells with the indices `changed` may
  /// have changed since the last call, or any cell if `redrawn` is true. O(cells changed), and O(cells of the
  /// rectangle) once a second.
  void note(Log& log, const Grid<std::uint8_t>& occupancy, bool redrawn, std::span<const std::size_t> changed,
            double time_s);

  /// Lets the next finish() log the whole map.
  void redraw() { redrawn_ = true; }

  /// Logs what was noted and not yet logged. Call it at the end of the run.
  void finish(Log& log, const Grid<std::uint8_t>& occupancy, double time_s);

 private:
  void log_whole(Log& log, const Grid<std::uint8_t>& occupancy, double time_s);
  void log_update(Log& log, const Grid<std::uint8_t>& occupancy, double time_s);

  double period_s_;
  GridFrame logged_{};    ///< frame of the newest whole map
  bool begun_ = false;    ///< a whole map was logged
  bool redrawn_ = false;  ///< the whole map must be logged
  Cell low_{0, 0};        ///< corners of the rectangle of changes
  Cell high_{-1, -1};
  double next_s_ = 0.0;
  double whole_s_ = 0.0;  ///< time of the newest whole map
};

}  // namespace outrider
