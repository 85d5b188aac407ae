#include "outrider/nodes/gap_measure.hpp"

#include <algorithm>

namespace outrider {
namespace {

constexpr double ahead_m = 0.6;   // of the way, that is looked at
constexpr double roomy_m = 0.06;  // beside the robot, where the way need not be in the middle
constexpr double point_m = 0.0005;
constexpr std::size_t least_scans = 6;

}  // namespace

void GapMeasure::add(const ScanPoints& scan, const RobotFrames& frames) {
  if (!scan.came_s() || scan.time_s() == scan_s_) return;
  const auto odometry = frames.odom_T_robot(scan.time_s());
  if (!odometry) return;
  scan_s_ = scan.time_s();
  odometry_ = *odometry;
  close_range_.add(odometry_, scan.points());
}

void GapMeasure::look(const NarrowWay& way, const Pose2& map_T_robot, double radius_m) {
  if (scan_s_ < 0.0 || scan_s_ == looked_s_) return;
  looked_s_ = scan_s_;
  const Nearby surfaces(close_range_.surfaces(odometry_, map_T_robot), point_m);
  PathProgress path{way.points, 0.0};
  const PathRoom room = centre_path(path, map_T_robot.position, surfaces, ahead_m, radius_m + roomy_m);
  rooms_.push_back(room);
}

std::optional<NarrowPlace> GapMeasure::gap() const {
  if (rooms_.size() < least_scans) return std::nullopt;
  std::vector<PathRoom> rooms = rooms_;
  const auto middle = rooms.begin() + static_cast<std::ptrdiff_t>(rooms.size() / 2);
  std::ranges::nth_element(rooms, middle, {}, &PathRoom::least_m);
  return NarrowPlace{middle->narrowest, 2.0 * middle->least_m, true, 1};
}

}  // namespace outrider
