// The parts of PolygonGround that are derived from its edges.
#pragma once

#include <optional>

#include "outrider/path/visibility/polygon_ground.hpp"

namespace outrider {

/// Makes the index from edges, bounds and radius.
EdgeIndex index_of(const PolygonGround& ground);

/// Returns the cell of a point; for points outside, the nearest cell.
std::size_t cell_of(const EdgeIndex& index, Vec2 p);

/// Returns true if the disk can move along s without touching the edge. segment_free() calls this for each
/// edge.
bool clear_of(const PolygonGround& ground, const Segment& edge, Segment s);

/// A ground that differs from another one by one polygon: the edges that the other does not have, and the box
/// of the added or removed polygon.
struct GroundBefore {
  const PolygonGround& ground;
  std::uint32_t gone_from = 0;
  std::uint32_t gone_count = 0;
  Box2 changed;

  /// Returns the same edge of that ground, if it is so far from the change that its arcs and walls are equal.
  [[nodiscard]] std::optional<std::uint32_t> unchanged(const PolygonGround& now, std::uint32_t edge) const;
};

/// Computes arcs and walls. Each circle around a corner and each offset edge is cut where it enters or leaves
/// the region that another edge forbids; a part is free if its middle is free.
void find_free_boundary(PolygonGround& ground, const GroundBefore* before);

}  // namespace outrider
