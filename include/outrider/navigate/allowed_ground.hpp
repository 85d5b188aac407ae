// AllowedGround: the area that a robot may not leave, as rings of edges: its borders and those of its holes.
//
// A place is inside if an odd number of rings is around it. What the robot sees at an edge, or beyond, is the
// edge. Thread rule: const functions may run concurrently. O(edges) a query.
#pragma once

#include <vector>

#include "outrider/geometry/vec.hpp"

namespace outrider {

class AllowedGround {
 public:
  /// Rings of at least three corners each, m; of either orientation, not closed by a repeated corner.
  explicit AllowedGround(std::vector<std::vector<Vec2>> rings);

  [[nodiscard]] bool contains(Vec2 place) const;
  /// Returns the distance to the nearest edge, m.
  [[nodiscard]] double to_edge_m(Vec2 place) const;
  /// Returns points on all edges, neighbours at most `step_m` apart.
  [[nodiscard]] std::vector<Vec2> edge_points(double step_m) const;

 private:
  std::vector<std::vector<Vec2>> rings_;
};

}  // namespace outrider
