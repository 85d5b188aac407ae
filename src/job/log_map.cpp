#include "outrider/job/log_map.hpp"

#include <cmath>
#include <limits>
#include <vector>

#include "outrider/log/messages/ros_messages.hpp"
#include "outrider/log/topics.hpp"
#include "outrider/world/occupancy.hpp"

namespace outrider {
namespace {

std::uint8_t occupancy_of(std::int8_t percent) {
  if (percent < 0) return unknown_cell;
  return percent >= 50 ? occupied_cell : free_cell;
}

/// Returns the map; an empty one if the message does not have as many cells as it says.
Grid<std::uint8_t> grid_of(const nav_msgs::OccupancyGrid& message) {
  constexpr std::uint64_t most = std::numeric_limits<int>::max();
  Grid<std::uint8_t> grid;
  const std::uint64_t cells = std::uint64_t{message.info.width} * message.info.height;
  if (cells != message.data.size() || message.info.width > most || message.info.height > most) return grid;
  // The resolution is logged in single precision.
  const double resolution_m = std::round(1e6 * static_cast<double>(message.info.resolution)) / 1e6;
  grid.frame = {{message.info.origin.position.x, message.info.origin.position.y},
                resolution_m,
                static_cast<int>(message.info.width),
                static_cast<int>(message.info.height)};
  for (const std::int8_t percent : message.data) grid.cells.push_back(occupancy_of(percent));
  return grid;
}

}  // namespace

void LogMap::read(const Log& log, const Changed& changed) {
  const auto& wholes = log.messages<nav_msgs::OccupancyGrid>(topic::map);
  const auto& updates = log.messages<map_msgs::OccupancyGridUpdate>(topic::map_updates);
  const auto next_whole_ns = [&] {
    return wholes_ < wholes.size() ? wholes[wholes_].time_ns : std::numeric_limits<std::int64_t>::max();
  };
  while (wholes_ < wholes.size() || updates_ < updates.size()) {
    if (updates_ == updates.size() || next_whole_ns() <= updates[updates_].time_ns) {
      const auto& whole = wholes[wholes_++];
      grid_ = grid_of(whole.message);
      if (changed) changed(grid_, true, {}, whole.time_s());
      continue;
    }
    const auto& [time_ns, update] = updates[updates_++];
    if (wholes_ > 0 && time_ns <= wholes[wholes_ - 1].time_ns) continue;  // a part of the whole map
    std::vector<std::size_t> cells;
    for (std::size_t i = 0; update.width > 0 && i < update.data.size(); ++i) {
      const Cell cell{update.x + static_cast<int>(i % update.width),
                      update.y + static_cast<int>(i / update.width)};
      if (!grid_.contains(cell)) continue;
      cells.push_back(grid_.frame.index(cell));
      grid_.cells[cells.back()] = occupancy_of(update.data[i]);
    }
    if (changed) changed(grid_, false, cells, seconds(time_ns));
  }
}

}  // namespace outrider
