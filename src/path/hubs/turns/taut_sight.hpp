// Finds the turns that a corner of a grid sees and at which a taut path from it may bend.
//
// A straight leg touches the blocked cell at a turn, and may bend around it there, if it neither enters nor
// leaves through the quadrant of that cell. Every leg of a shortest path between two turns satisfies this at
// both. The search walks from polygon to polygon of the mesh, each with the cone in which the corner sees it.
// Cones are bounded by corners and compared in integers, so visibility is exact. A turn straight behind
// another one is omitted, because the first is on the path. O(sides of the polygons seen). Thread rule: one
// instance per thread.
#pragma once

#include <cstdint>
#include <vector>

#include "winding.hpp"

namespace outrider::hub_labelling {

class TautSight {
 public:
  TautSight(const GridMap& ground, const NavigationMesh& mesh) : ground_(ground), mesh_(mesh) {}

  /// Returns the visible turns as indices of mesh.turns, ascending, without the corner itself.
  const std::vector<std::uint32_t>& from(Cell corner) { return seen_from(corner, true); }
  /// Returns those turns too at which a path from the corner may not bend.
  const std::vector<std::uint32_t>& all_from(Cell corner) { return seen_from(corner, false); }

 private:
  struct Arrow {
    std::int32_t x = 0, y = 0;
  };
  struct Cone {  ///< open: what lies on its edges is hidden or seen already
    Arrow right, left;
    std::uint32_t side = 0;  ///< through which it looks, as the polygon behind has it
    std::uint32_t polygon = 0;
  };
  static std::int64_t turned(Arrow a, Arrow b) { return std::int64_t{a.x} * b.y - std::int64_t{a.y} * b.x; }
  [[nodiscard]] Arrow arrow(Cell v) const { return {v.x - corner_.x, v.y - corner_.y}; }
  [[nodiscard]] std::uint32_t after(std::uint32_t side, std::uint32_t polygon) const {
    return side + 1 == mesh_.first[polygon + 1] ? mesh_.first[polygon] : side + 1;
  }
  const std::vector<std::uint32_t>& seen_from(Cell corner, bool taut);
  void see(const NavigationMesh::Side& side, Arrow way);
  void look_everywhere(std::uint32_t polygon);
  void look_through(const Cone& cone);

  const GridMap& ground_;
  const NavigationMesh& mesh_;
  Cell corner_;
  bool taut_ = true;
  std::vector<std::uint32_t> around_, seen_;
  std::vector<Cone> cones_;
};

}  // namespace outrider::hub_labelling
