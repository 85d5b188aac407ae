// The marks of a TraversabilityGrid: where the robot touched something, and cells opened or shut for it.
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

void TraversabilityGrid::mark_around(Vec2 point, double reach_m, std::uint8_t value) {
  const std::size_t settled = stale_.size();
  ++clock_;
  const Vec2 reach{reach_m, reach_m};
  const Cell low = known_.frame.cell_at(point - reach), high = known_.frame.cell_at(point + reach);
  for (int y = low.y; y <= high.y; ++y) {
    for (int x = low.x; x <= high.x; ++x) {
      if (distance(known_.frame.centre({x, y}), point) < reach_m) mark({x, y}, value);
    }
  }
  settle(settled);
}

void TraversabilityGrid::mark_touched(Vec2 point) {
  mark_around(point, radius_m_ + touch_gap_m, touched_mark);
}

void TraversabilityGrid::mark_shut(Vec2 point, double reach_m) { mark_around(point, reach_m, shut_mark); }

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
