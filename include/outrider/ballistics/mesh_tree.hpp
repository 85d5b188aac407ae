// MeshTree: the distance from a mesh, without looking at all of its triangles.
#pragma once

#include <array>
#include <vector>

#include "outrider/ballistics/box_tree.hpp"
#include "outrider/world/solid.hpp"

namespace outrider {

class MeshTree {
 public:
  /// O(n log^2 n).
  explicit MeshTree(const MeshShape& mesh);

  /// Returns the distance from p, in the frame of the mesh, to the nearest triangle, m; infinite if there is
  /// none. The same number as that of a search of all triangles. Branch and bound: O(log n) for a p that is
  /// near to few triangles.
  [[nodiscard]] double distance(Vec3 p) const;

 private:
  std::vector<std::array<Vec3, 3>> triangles_;
  BoxTree tree_;
};

}  // namespace outrider
