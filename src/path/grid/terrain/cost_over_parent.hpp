// The cost of a path in any direction, with that of the parent of its last vertex.
#pragma once

namespace outrider {

/// Cost of a path to a vertex. The cost of the vertex's parent is kept with it, so that a search need not ask
/// for costs of closed vertices.
struct CostOverParent {
  double g = 0.0;
  double parent_g = 0.0;

  friend bool operator<(const CostOverParent& a, const CostOverParent& b) { return a.g < b.g; }
};

}  // namespace outrider
