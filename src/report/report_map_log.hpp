// Logs the map of a report: the whole map, then an update for each step in which it has grown.
#pragma once

#include <cstdint>
#include <vector>

#include "outrider/log/conversions.hpp"
#include "outrider/log/log.hpp"
#include "outrider/log/topics.hpp"
#include "outrider/report/report.hpp"
#include "outrider/world/occupancy.hpp"

namespace outrider {

inline std::vector<int> cells_of(const std::vector<int>& runs) {
  std::vector<int> cells;
  for (std::size_t i = 0; i + 1 < runs.size(); i += 2)
    cells.insert(cells.end(), static_cast<std::size_t>(runs[i + 1]), runs[i]);
  return cells;
}

inline void add_map(Log& log, const ReportMap& map) {
  const std::vector<int> states = cells_of(map.state_runs), steps = cells_of(map.known_runs);
  const auto width = static_cast<std::uint32_t>(map.columns), height = static_cast<std::uint32_t>(map.rows);
  nav_msgs::OccupancyGrid grid;
  grid.header = header_of(0.0, "map");
  grid.info.resolution = static_cast<float>(map.cell_m);
  grid.info.width = width;
  grid.info.height = height;
  grid.info.origin = pose_of(Pose2{map.origin, 0.0});
  grid.data.assign(states.size(), -1);
  log.append(topic::map, 0.0, grid);
  int last = -1;
  for (std::size_t i = 0; i < states.size(); ++i) {
    if (states[i] != unknown_cell) last = std::max(last, steps[i]);
  }
  for (int step = 0; step <= last; ++step) {
    std::uint32_t x0 = width, y0 = height, x1 = 0, y1 = 0;
    for (std::size_t i = 0; i < states.size(); ++i) {
      if (states[i] == unknown_cell || steps[i] != step) continue;
      grid.data[i] = states[i] == occupied_cell ? 100 : 0;
      const auto x = static_cast<std::uint32_t>(i) % width, y = static_cast<std::uint32_t>(i) / width;
      x0 = std::min(x0, x), y0 = std::min(y0, y), x1 = std::max(x1, x + 1), y1 = std::max(y1, y + 1);
    }
    if (x1 == 0) continue;
    const double time_s = step * map.step_s;
    map_msgs::OccupancyGridUpdate update{header_of(time_s, "map"),
                                         static_cast<std::int32_t>(x0),
                                         static_cast<std::int32_t>(y0),
                                         x1 - x0,
                                         y1 - y0,
                                         {}};
    for (std::uint32_t y = y0; y < y1; ++y) {
      const auto row = grid.data.begin() + static_cast<std::ptrdiff_t>(y * width);
      update.data.insert(update.data.end(), row + x0, row + x1);
    }
    log.append(topic::map_updates, time_s, std::move(update));
  }
}

}  // namespace outrider
