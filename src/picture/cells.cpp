#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "draw.hpp"
#include "outrider/log/conversions.hpp"
#include "outrider/log/gun_messages.hpp"
#include "outrider/log/motion_messages.hpp"
#include "outrider/log/topics.hpp"

namespace outrider::picture {
namespace {

constexpr std::int16_t steps = 10, full = steps, none = -1;

/// A grid of steps on a scale of colours, 0 to 9, or `full`, or `none`, which is not drawn.
struct Cells {
  Pose2 origin;
  double cell_m = 1.0;
  std::size_t columns = 0, rows = 0;
  std::vector<std::int16_t> steps = {};
};

/// The colours of the first and the last step, and the words of the legend for them and for `full`.
struct Scale {
  unsigned first_rgb, last_rgb;
  std::string first, last, full = {};
};

std::int16_t step_of(double share) {
  if (!std::isfinite(share)) return none;
  return static_cast<std::int16_t>(std::clamp(share * steps, 0.0, steps - 1.0));
}

/// Returns a path for each step of merged horizontal runs, in cells. A block has the highest step in it.
std::array<std::string, steps + 1> runs_of(const Cells& cells, std::size_t block) {
  std::array<std::string, steps + 1> paths;
  for (std::size_t y = 0; y < cells.rows; y += block) {
    const std::size_t top = std::min(y + block, cells.rows);
    std::vector<std::int16_t> row((cells.columns + block - 1) / block, none);
    for (std::size_t i = y * cells.columns; i < top * cells.columns; ++i) {
      row[i % cells.columns / block] = std::max(row[i % cells.columns / block], cells.steps[i]);
    }
    for (std::size_t first = 0, end = 0; first < row.size(); first = end) {
      while (end < row.size() && row[end] == row[first]) ++end;
      const std::size_t x = first * block, width = std::min(end * block, cells.columns) - x;
      if (row[first] == none) continue;
      paths[static_cast<std::size_t>(row[first])] +=
          fmt::format("M{} {}h{}v{}h-{}z", x, y, width, top - y, width);
    }
  }
  return paths;
}

/// Draws the cells; blocks that are too small to be seen become one cell.
void put(Sheet& sheet, const Cells& cells, const Scale& scale) {
  const auto columns = static_cast<double>(cells.columns), rows = static_cast<double>(cells.rows);
  if (cells.steps.empty() || cells.steps.size() != cells.columns * cells.rows) return;
  const auto place = [&](double x, double y) { return sheet.at(cells.origin * (cells.cell_m * Vec2{x, y})); };
  const Vec2 corner = place(0.0, 0.0), right = place(columns, 0.0) - corner, up = place(0.0, rows) - corner;
  const double block = std::ceil(3.0 * sheet.detail_px / (sheet.px_per_m * cells.cell_m));
  if (!finite(place(columns, rows)) || !(block > 0.0)) return;
  const auto paths = runs_of(cells, static_cast<std::size_t>(std::min(block, 1e6)));
  sheet.body +=
      fmt::format("<g transform=\"matrix({:.6g} {:.6g} {:.6g} {:.6g} {:.2f} {:.2f})\">\n", right.x / columns,
                  right.y / columns, up.x / rows, up.y / rows, corner.x, corner.y);
  for (int step = 0; step < steps; ++step) {
    sheet.put("cells", paths[static_cast<std::size_t>(step)], area_sample,
              step == 0           ? scale.first
              : step == steps - 1 ? scale.last
                                  : "",
              "fill:" + mixed(scale.first_rgb, scale.last_rgb, step / (steps - 1.0)));
  }
  sheet.put("cells full", paths[full], area_sample, scale.full);
  sheet.body += "</g>\n";
}

template <class StepOf>
Cells cells_of(const nav_msgs::OccupancyGrid* grid, const StepOf& step_of_percent) {
  if (grid == nullptr) return {};
  const auto& info = grid->info;
  Cells cells{pose_of(info.origin), static_cast<double>(info.resolution), info.width, info.height};
  for (const std::int8_t percent : grid->data)
    cells.steps.push_back(static_cast<std::int16_t>(step_of_percent(percent)));
  return cells;
}

/// Returns the map at the end of the log.
Cells final_map(const Log& log) {
  const auto step = [](int percent) { return percent < 0 ? none : percent >= 50 ? full : 0; };
  const auto& maps = log.messages<nav_msgs::OccupancyGrid>(topic::map);
  Cells map = cells_of(log.latest<nav_msgs::OccupancyGrid>(topic::map), step);
  for (const auto& [time_ns, update] : log.messages<map_msgs::OccupancyGridUpdate>(topic::map_updates)) {
    if (maps.empty() || time_ns <= maps.back().time_ns || update.width == 0) continue;
    for (std::size_t i = 0; i < update.data.size(); ++i) {
      const std::size_t x = static_cast<std::size_t>(update.x) + i % update.width;
      const std::size_t y = static_cast<std::size_t>(update.y) + i / update.width;
      if (x < map.columns && y * map.columns + x < map.steps.size())
        map.steps[y * map.columns + x] = static_cast<std::int16_t>(step(update.data[i]));
    }
  }
  return map;
}

/// Draws costs on a logarithmic scale.
void draw_costs(Sheet& sheet, const Log& log) {
  const auto* grid = log.latest<outrider_msgs::CostGrid>(topic::cost_grid);
  const auto* paid = log.latest<outrider_msgs::PaidCost>(topic::paid);
  if (grid == nullptr) return;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const double cost : grid->costs) {
    if (cost >= 0.0 && std::isfinite(cost)) low = std::min(low, cost), high = std::max(high, cost);
  }
  const double span = std::max(1e-12, std::log1p(high) - std::log1p(low));
  Cells cells{{vec2_of(grid->origin), 0.0}, grid->resolution, grid->width, grid->height};
  for (const double cost : grid->costs) {
    cells.steps.push_back(cost < 0.0 ? full : step_of((std::log1p(cost) - std::log1p(low)) / span));
  }
  put(sheet, cells,
      {0xfbfaf5, 0xa07a40, fmt::format("cost {:g}", low), fmt::format("cost {:g}", high), "wall"});
  if (paid != nullptr) sheet.put("cells", "M0 0", "", fmt::format("paid in all: {:g}", paid->paid));
}

/// Draws how many targets can be hit from each cell.
void draw_firing_regions(Sheet& sheet, const Log& log) {
  const auto& regions = log.messages<outrider_msgs::FiringRegion>(topic::firing_regions);
  if (regions.empty()) return;
  Cells count = cells_of(&regions.front().message.grid, [](int percent) { return percent < 0 ? none : 0; });
  for (const auto& region : regions) {
    const auto& data = region.message.grid.data;
    for (std::size_t i = 0; i < std::min(data.size(), count.steps.size()); ++i)
      count.steps[i] = static_cast<std::int16_t>(count.steps[i] + (data[i] > 0 ? 1 : 0));
  }
  const int most = std::max(1, count.steps.empty() ? 0 : std::ranges::max(count.steps));
  for (std::int16_t& step : count.steps) {
    if (step > 0) step = step_of(0.1 + 0.9 * static_cast<double>(step) / most);
  }
  put(sheet, count,
      {0xf8f6fb, 0x9482bd, "no target in range",
       fmt::format("{} of {} targets in range", most, regions.size())});
}

}  // namespace

void draw_cells(Sheet& sheet, const Log& log) {
  const Cells map = final_map(log);
  const auto& [low, high] = sheet.box;
  if (!map.steps.empty()) {
    sheet.put("unknown", sheet.area({low, {high.x, low.y}, high, {low.x, high.y}}), area_sample,
              "not mapped");
  }
  put(sheet, map, {0xffffff, 0xffffff, "mapped: free", "", "mapped: occupied"});
  draw_costs(sheet, log);
  draw_firing_regions(sheet, log);
  const auto room = [](int percent) { return percent == 99 ? 0 : percent > 99 ? full : none; };
  put(sheet, cells_of(log.latest<nav_msgs::OccupancyGrid>(topic::costmap), room),
      {0xf3ded3, 0xf3ded3, "no room for the robot's centre", "", "occupied"});
  const auto turn = [](int percent) { return percent < 0 ? none : step_of(percent / 100.0); };
  put(sheet, cells_of(log.latest<nav_msgs::OccupancyGrid>(topic::expanded), turn),
      {0xffe9a8, 0xd97a2b, "expanded first", "expanded last"});
}

}  // namespace outrider::picture
