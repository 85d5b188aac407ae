#include "outrider/path/grid/terrain/cell_costs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <utility>

namespace outrider {

Outcome<CellCosts> CellCosts::of(Grid<float> per_m) {
  const GridFrame& frame = per_m.frame;
  if (per_m.cells.empty() || per_m.cells.size() != frame.size()) {
    return bad_input(fmt::format("a grid of {} x {} cells came with {} costs; give one for each cell",
                                 frame.width, frame.height, per_m.cells.size()));
  }
  for (std::size_t i = 0; i < per_m.cells.size(); ++i) {
    const float cost = per_m.cells[i];
    const bool good = cost >= least_cost_per_m && cost <= most_cost_per_m;
    if (good) continue;
    const Cell c = frame.cell(i);
    return bad_input(fmt::format("the cost {} of cell ({}, {}) is not valid; a metre costs from {} to {}",
                                 cost, c.x, c.y, least_cost_per_m, most_cost_per_m));
  }
  const auto least = static_cast<double>(*std::min_element(per_m.cells.begin(), per_m.cells.end()));
  return CellCosts{std::move(per_m), least};
}

/// Walks from border to border. The i-th vertical border is crossed at the share (2 i - 1) / (2 dx) of the
/// leg, the i-th horizontal one at (2 i - 1) / (2 dy); the order is exact, in whole numbers.
double cost_of_leg(const CellCosts& costs, Cell from, Cell to) {
  const std::int64_t dx = std::abs(to.x - from.x), dy = std::abs(to.y - from.y);
  const int step_x = to.x < from.x ? -1 : 1, step_y = to.y < from.y ? -1 : 1;
  const double length = std::sqrt(static_cast<double>(dx * dx + dy * dy));
  std::int64_t i = 1, j = 1;
  double at = 0.0, sum = 0.0;
  Cell cell = from;
  while (i <= dx || j <= dy) {
    const std::int64_t order = (2 * i - 1) * dy - (2 * j - 1) * dx;  // < 0: the vertical border comes first
    const bool by_x = i <= dx && (j > dy || order <= 0), by_y = j <= dy && (i > dx || order >= 0);
    const double next = by_x ? static_cast<double>(2 * i - 1) / static_cast<double>(2 * dx)
                             : static_cast<double>(2 * j - 1) / static_cast<double>(2 * dy);
    sum += (next - at) * static_cast<double>(costs.per_m[cell]);
    at = next;
    if (by_x) {
      cell.x += step_x;
      ++i;
    }
    if (by_y) {
      cell.y += step_y;
      ++j;
    }
  }
  return length * (sum + (1.0 - at) * static_cast<double>(costs.per_m[cell]));
}

}  // namespace outrider
