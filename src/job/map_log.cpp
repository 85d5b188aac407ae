#include "outrider/job/map_log.hpp"

#include <algorithm>

#include "outrider/job/grid_message.hpp"
#include "outrider/log/messages/conversions.hpp"
#include "outrider/log/topics.hpp"
#include "outrider/world/occupancy.hpp"

namespace outrider {
namespace {

/// Returns the probability that a cell is occupied, in percent; -1 if it is unknown.
std::int8_t percent(std::uint8_t cell) {
  if (cell == unknown_cell) return -1;
  return cell == occupied_cell ? 100 : 0;
}

}  // namespace

void log_map(Log& log, const Grid<std::uint8_t>& occupancy, double yaw_rad, double time_s) {
  auto grid = grid_message(occupancy.frame, yaw_rad, log.time_of(time_s));
  grid.data.resize(occupancy.cells.size());
  std::ranges::transform(occupancy.cells, grid.data.begin(), percent);
  log.append(topic::map, time_s, std::move(grid));
}

void MapLog::note(Log& log, const Grid<std::uint8_t>& occupancy, bool redrawn,
                  std::span<const std::size_t> changed, double time_s) {
  redrawn_ = redrawn_ || redrawn || !begun_ || logged_ != occupancy.frame;
  for (const std::size_t index : redrawn_ ? std::span<const std::size_t>{} : changed) {
    const Cell cell = occupancy.frame.cell(index);
    const bool first = high_.x < low_.x;
    low_ = first ? cell : Cell{std::min(low_.x, cell.x), std::min(low_.y, cell.y)};
    high_ = first ? cell : Cell{std::max(high_.x, cell.x), std::max(high_.y, cell.y)};
  }
  if (time_s < next_s_) return;
  finish(log, occupancy, time_s);
  next_s_ = time_s + period_s_;
}

void MapLog::finish(Log& log, const Grid<std::uint8_t>& occupancy, double time_s) {
  const bool changed = high_.x >= low_.x;
  if (redrawn_ || (changed && time_s == whole_s_)) {
    log_whole(log, occupancy, time_s);
  } else if (changed) {
    log_update(log, occupancy, time_s);
  }
  redrawn_ = false;
  low_ = {0, 0};
  high_ = {-1, -1};
}

void MapLog::log_whole(Log& log, const Grid<std::uint8_t>& occupancy, double time_s) {
  logged_ = occupancy.frame;
  begun_ = true;
  whole_s_ = time_s;
  log_map(log, occupancy, 0.0, time_s);
}

void MapLog::log_update(Log& log, const Grid<std::uint8_t>& occupancy, double time_s) {
  const int width = high_.x - low_.x + 1, height = high_.y - low_.y + 1;
  map_msgs::OccupancyGridUpdate update{
      header_of(log.time_of(time_s), "map"), low_.x, low_.y, static_cast<std::uint32_t>(width),
      static_cast<std::uint32_t>(height),    {}};
  for (int y = low_.y; y <= high_.y; ++y) {
    const auto row =
        occupancy.cells.begin() + static_cast<std::ptrdiff_t>(occupancy.frame.index({low_.x, y}));
    std::transform(row, row + width, std::back_inserter(update.data), percent);
  }
  log.append(topic::map_updates, time_s, std::move(update));
}

}  // namespace outrider
