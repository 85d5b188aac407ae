// The parts of PolygonGround that are derived from its edges.
#pragma once

#include "outrider/path/polygon_ground.hpp"

namespace outrider {

/// Reads edges, bounds and radius.
EdgeIndex index_of(const PolygonGround& ground);

/// The cell of a point; points outside count to the nearest cell.
std::size_t cell_of(const EdgeIndex& index, Vec2 p);

/// Fills arcs and walls. Each circle about a corner and each moved edge is cut where it enters or
/// leaves what another edge forbids; a part is free when its middle is.
void find_free_boundary(PolygonGround& ground);

}  // namespace outrider
