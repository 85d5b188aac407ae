#include "laser/scan_map.hpp"

#include "outrider/core/units.hpp"

namespace outrider {

void ScanMap::add(Log& log, const Pose2& world_T_robot, const LaserScan& scan, double time_s) {
  const MapUpdate update = map_.insert(wrap_heading(compose(world_T_robot, robot_T_laser_)), scan);
  logged_.note(log, map_.occupancy(), update.redrawn, update.cells, time_s);
}

void ScanMap::finish(Log& log, const Grid<std::uint8_t>& occupancy, double time_s) {
  logged_.redraw();
  logged_.finish(log, occupancy, time_s);
}

}  // namespace outrider
