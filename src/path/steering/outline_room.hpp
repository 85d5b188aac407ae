// OutlineRoom: how much room there is around each cell, so that most poses of a robot with an outline need no
// sweep, and where its origin cannot be at all, which guides the search around gaps that are too narrow.
//
// From the distances between the centres of cells (clearance.hpp): bounds for any point of a cell and any
// point of a blocked one. For a disk nothing is prepared and nothing told. O(cells).
#pragma once

#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/path/grid/grid_map.hpp"
#include "outrider/world/clearance.hpp"

namespace outrider {

class OutlineRoom {
 public:
  /// Prepares for a ground, which must outlive it, and an outline in cells. Fault: cancelled.
  Status begin(const GridMap& ground, const std::vector<Vec2>& outline, const std::stop_token& stop);

  /// The ground with the cells blocked too where the largest disk in the outline touches one that is.
  [[nodiscard]] const GridMap& narrowed() const { return tells_ ? narrowed_ : *ground_; }
  /// Returns true if nothing is within reach of a robot that begins at p, in whatever heading, and drives
  /// that far; false tells nothing.
  [[nodiscard]] bool is_wide(Vec2 p, double length) const;
  /// Returns true if a robot at p touches a blocked cell in every heading; false tells nothing.
  [[nodiscard]] bool is_blocked(Vec2 p) const;

 private:
  const GridMap* ground_ = nullptr;
  bool tells_ = false;
  double outer_ = 0.0;
  GridMap narrowed_;
  Grid<std::uint32_t> squared_;  // with a rim of blocked cells
};

}  // namespace outrider
