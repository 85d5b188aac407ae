#include "hub_kept.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "outrider/path/grid/line_of_sight.hpp"

namespace outrider::hub_labelling {
namespace {

double distance_to(const CellBox& box, Cell v) {
  const double x = std::max({box.low.x - v.x, v.x - box.high.x, 0});
  const double y = std::max({box.low.y - v.y, v.y - box.high.y, 0});
  return std::sqrt(x * x + y * y);
}

/// Returns the octile distance of the centre of a cell from a box, half cells.
Octile half_cells_to(const CellBox& box, Cell c) {
  const Cell at{2 * c.x + 1, 2 * c.y + 1};
  const Cell nearest{std::clamp(at.x, 2 * box.low.x, 2 * box.high.x),
                     std::clamp(at.y, 2 * box.low.y, 2 * box.high.y)};
  return octile_distance(at, nearest);
}

/// Cells side by side in a row, row by row.
std::vector<CellBox> freed_runs(const GridMap& now, const std::vector<Cell>& changed) {
  std::vector<CellBox> runs;
  for (const Cell c : changed) {
    if (now.blocked(c)) continue;
    if (!runs.empty() && runs.back().low.y == c.y && runs.back().high.x == c.x) {
      ++runs.back().high.x;
    } else {
      runs.push_back({c, {c.x + 1, c.y + 1}});
    }
  }
  return runs;
}

}  // namespace

std::vector<CellBox> freed_boxes(const GridMap& now, const std::vector<Cell>& changed) {
  std::vector<CellBox> runs = freed_runs(now, changed), boxes;
  std::sort(runs.begin(), runs.end(), [](const CellBox& a, const CellBox& b) {
    if (a.low.x != b.low.x) return a.low.x < b.low.x;
    return a.high.x != b.high.x ? a.high.x < b.high.x : a.low.y < b.low.y;
  });
  for (const CellBox& run : runs) {
    const bool on_top = !boxes.empty() && boxes.back().low.x == run.low.x &&
                        boxes.back().high.x == run.high.x && boxes.back().high.y == run.low.y;
    if (on_top) {
      boxes.back().high.y = run.high.y;
    } else {
      boxes.push_back(run);
    }
  }
  return boxes;
}

double least_length_over(std::span<const CellBox> boxes, Cell start, Cell goal) {
  double least = std::numeric_limits<double>::infinity();
  for (const CellBox& box : boxes) least = std::min(least, distance_to(box, start) + distance_to(box, goal));
  return least;
}

bool none_shorter_over(std::span<const CellBox> boxes, Cell start, Cell goal, Octile length) {
  const Octile twice = length + length;  // half cells
  return std::none_of(boxes.begin(), boxes.end(), [&](const CellBox& box) {
    return half_cells_to(box, start) + half_cells_to(box, goal) < twice;
  });
}

bool legal_way(const GridMap& ground, std::span<const Cell> way) {
  for (std::size_t i = 1; i < way.size(); ++i) {
    if (i > 1 && ground.pinch(way[i - 1])) return false;
    if (!visible(ground, way[i - 1], way[i])) return false;
  }
  return true;
}

}  // namespace outrider::hub_labelling
