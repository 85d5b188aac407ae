// The parts of PolygonGround that are derived from its edges.
#pragma once

#include <optional>

#include "outrider/path/visibility/polygon_ground.hpp"

namespace outrider {

/// Reads edges, bounds and radius.
EdgeIndex index_of(const PolygonGround& ground);

/// The cell of a point; points outside count to the nearest cell.
std::size_t cell_of(const EdgeIndex& index, Vec2 p);

/// What segment_free() asks of each edge.
bool clear_of(const PolygonGround& ground, const Segment& edge, Segment s);

/// A ground from which another differs by one polygon: the edges that are not in the other, and the box of
/// the polygon that came or went.
struct GroundBefore {
  const PolygonGround& ground;
  std::uint32_t gone_from = 0;
  std::uint32_t gone_count = 0;
  Box2 changed;

  /// The same edge of that ground, when it is so far from the change that its arcs and walls are the same.
  [[nodiscard]] std::optional<std::uint32_t> unchanged(const PolygonGround& now, std::uint32_t edge) const;
};

/// Fills arcs and walls. Each circle about a corner and each moved edge is cut where it enters or
/// leaves what another edge forbids; a part is free when its middle is.
void find_free_boundary(PolygonGround& ground, const GroundBefore* before);

}  // namespace outrider
