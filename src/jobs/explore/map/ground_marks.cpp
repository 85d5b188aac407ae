// The marks of a TraversabilityGrid: where the robot touched something, and cells opened for it.
#include <optional>
#include <utility>

#include "outrider/jobs/explore/map/traversability_grid.hpp"
#include "outrider/world/grid_ray.hpp"

namespace outrider {

void TraversabilityGrid::mark(Cell cell, std::uint8_t mark) {
  if (!known_.contains(cell)) return;
  const auto index = static_cast<std::uint32_t>(known_.frame.index(cell));
  if ((marks_[index] & mark) != 0) return;
  marks_[index] = static_cast<std::uint8_t>(marks_[index] | mark);
  stale_.push_back(index);
}

void TraversabilityGrid::mark_touched(Vec2 point) {
  const std::size_t settled = stale_.size();
  ++clock_;
  const double apart_m = radius_m_ + touch_gap_m;
  const Vec2 reach{apart_m, apart_m};
  const Cell low = known_.frame.cell_at(point - reach), high = known_.frame.cell_at(point + reach);
  for (int y = low.y; y <= high.y; ++y) {
    for (int x = low.x; x <= high.x; ++x) {
      if (distance(known_.frame.centre({x, y}), point) < apart_m) mark({x, y}, touched_mark);
    }
  }
  settle(settled);
}

bool TraversabilityGrid::mark_open(Segment way) {
  const std::size_t settled = stale_.size();
  ++clock_;
  const auto point = [&](Vec2 p) {
    return lattice_point(1.0 / known_.frame.resolution_m * (p - known_.frame.origin));
  };
  std::optional<Cell> before;
  cross_cells(point(way.a), point(way.b), [&](Cell cell) {
    mark(cell, open_mark);
    // Past a corner, the robot passes through one of the cells beside it.
    if (before && before->x != cell.x && before->y != cell.y) mark({before->x, cell.y}, open_mark);
    before = cell;
  });
  settle(settled);
  return stale_.size() > settled;
}

void TraversabilityGrid::forget_marks() {
  const std::size_t settled = stale_.size();
  ++clock_;
  for (std::uint32_t cell = 0; cell < marks_.size(); ++cell) {
    if (std::exchange(marks_[cell], std::uint8_t{0}) != 0) stale_.push_back(cell);
  }
  settle(settled);
}

}  // namespace outrider
