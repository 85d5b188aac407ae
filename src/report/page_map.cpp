#include "page_map.hpp"

#include "outrider/log/conversions.hpp"
#include "outrider/log/ros_sensor_messages.hpp"
#include "outrider/log/topics.hpp"
#include "outrider/report/discovery.hpp"
#include "outrider/report/log_map.hpp"

namespace outrider {

ReportMap page_map(const Log& log) {
  Discovery discovery;
  LogMap map;
  map.read(log, [&](const Grid<std::uint8_t>& grid, bool whole, std::span<const std::size_t> cells,
                    double time_s) { discovery.note(grid, whole, cells, time_s); });
  return map.grid().cells.empty() ? ReportMap{} : discovery.map(map.grid());
}

std::optional<ReportLaser> laser_of(const Log& log) {
  const auto& scans = log.messages<sensor_msgs::LaserScan>(topic::scan);
  if (scans.empty()) return std::nullopt;
  ReportLaser laser;
  laser.beams = static_cast<int>(scans.front().message.ranges.size());
  laser.range_m = static_cast<double>(scans.front().message.range_max);
  for (const auto& stamped : log.messages<tf2_msgs::TFMessage>(topic::static_transforms)) {
    for (const auto& one : stamped.message.transforms) {
      if (one.child_frame_id != "laser") continue;
      const auto& at = one.transform.translation;
      laser.mount = {{at.x, at.y}, heading_of(one.transform.rotation)};
      laser.height_m = at.z;
    }
  }
  return laser;
}

}  // namespace outrider
