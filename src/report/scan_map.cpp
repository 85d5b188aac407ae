#include "outrider/report/scan_map.hpp"

#include "outrider/core/units.hpp"

namespace outrider {

void ScanMap::add(const Pose2& world_T_robot, const LaserScan& scan, double time_s, std::size_t pose_number) {
  kept_.push_back({&scan, time_s, pose_number});
  insert(world_T_robot, kept_.back());
}

void ScanMap::redraw(const std::vector<Pose2>& poses) {
  map_ = OccupancyMap(options_);
  discovery_ = {};
  for (const Kept& kept : kept_) insert(poses[kept.pose_number], kept);
}

void ScanMap::insert(const Pose2& world_T_robot, const Kept& kept) {
  Pose2 world_T_laser = compose(world_T_robot, robot_T_laser_);
  world_T_laser.heading_rad = wrap_angle(world_T_laser.heading_rad);
  const MapUpdate update = map_.insert(world_T_laser, *kept.scan);
  discovery_.note(map_.occupancy(), update.redrawn, update.cells, kept.time_s);
}

}  // namespace outrider
