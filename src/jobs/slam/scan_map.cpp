#include "scan_map.hpp"

#include "outrider/core/units.hpp"

namespace outrider {

void ScanMap::add(Log& log, const Pose2& world_T_robot, const LaserScan& scan, double time_s,
                  std::size_t pose_number) {
  if (!final_poses_) kept_.push_back({scan, pose_number});
  const MapUpdate update = insert(world_T_robot, scan);
  logged_.note(log, map_.occupancy(), update.redrawn, update.cells, time_s);
}

void ScanMap::finish(Log& log, const std::vector<Pose2>& poses, double time_s) {
  if (!final_poses_) map_ = OccupancyMap(options_);
  for (const Kept& kept : kept_) insert(poses[kept.pose_number], kept.scan);
  logged_.redraw();
  logged_.finish(log, map_.occupancy(), time_s);
}

MapUpdate ScanMap::insert(const Pose2& world_T_robot, const LaserScan& scan) {
  Pose2 world_T_laser = compose(world_T_robot, robot_T_laser_);
  world_T_laser.heading_rad = wrap_angle(world_T_laser.heading_rad);
  return map_.insert(world_T_laser, scan);
}

}  // namespace outrider
