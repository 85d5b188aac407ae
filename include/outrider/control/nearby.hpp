// Nearby: the obstacles around a robot, for many clearance queries near one place.
//
// It collects the occupied cells of a map in a square once, or takes the points of a range scan. Each query
// visits all of them. Construction is O(cells in the square), a query O(occupied cells found). Thread rule:
// const queries may run concurrently.
#pragma once

#include <utility>
#include <vector>

#include "outrider/geometry/convex.hpp"
#include "outrider/world/grid.hpp"
#include "outrider/world/occupancy.hpp"

namespace outrider {

/// Obstacles around a place.
class Nearby {
 public:
  Nearby() = default;
  /// Takes the occupied cells whose centres are within `reach_m` of the middle in x and in y.
  Nearby(const Grid<std::uint8_t>& map, Vec2 middle, double reach_m);
  /// Takes squares around points. `half_m` is half the side of a square and must be positive.
  Nearby(std::vector<Vec2> points, double half_m) : centres_(std::move(points)), half_m_(half_m) {}

  /// Adds obstacles that are points.
  void add(const std::vector<Vec2>& points) { points_.insert(points_.end(), points.begin(), points.end()); }

  /// Returns the distance to the nearest closed square or point, m; infinite if there are none.
  [[nodiscard]] double clearance(Vec2 p) const;
  /// Returns the least clearance along a segment, with an error of at most a tenth of a cell.
  [[nodiscard]] double clearance(Segment s) const;

 private:
  std::vector<Vec2> centres_;
  std::vector<Vec2> points_;
  double half_m_ = 0.0;  // half the side of a square
};

}  // namespace outrider
