// OutlineWay: how near a robot with a convex outline comes to cells on one piece of its path, for the judges
// of plans. Shares no code with the planners. In cells.
#pragma once

#include <vector>

#include "outrider/geometry/convex.hpp"
#include "outrider/path/plan.hpp"

namespace outrider {

class OutlineWay {
 public:
  /// The piece, of the plan's unit, is brought into cells. `outline` is as in Problem; empty: a point.
  OutlineWay(const PathPiece& piece, double heading_rad, const std::vector<Vec2>& outline,
             const GridFrame& frame);

  /// Returns a box that contains all that the robot covers.
  [[nodiscard]] const Box2& bounds() const { return bounds_; }
  /// Returns false if the robot stays farther than that from the cell; true tells nothing. O(1).
  [[nodiscard]] bool may_come_to(Cell cell, double within) const;
  /// Returns the least distance of the robot to the closed square of the cell; 0 where it touches. Exact:
  /// two convex shapes are nearest at a corner of one, so it is that at the begin, or of the ways of the
  /// corners of the robot to the sides of the cell, or, as the robot sees them, of those of the cell to its
  /// sides. O(corners).
  [[nodiscard]] double gap(Cell cell) const;

 private:
  PathPiece piece_;
  double heading_rad_;
  std::vector<Vec2> outline_;
  std::vector<PathPiece> ways_;  // of its corners
  RoundedPolygon begin_;         // the robot at the beginning
  Box2 bounds_;
  double outer_ = 0.0;
};

}  // namespace outrider
