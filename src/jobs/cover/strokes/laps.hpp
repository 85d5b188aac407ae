// Laps: closed ways along everything that bounds where a disk may stand.
#pragma once

#include "outrider/jobs/cover/strokes/track.hpp"
#include "outrider/path/visibility/polygon_ground.hpp"

namespace outrider::cover {

/// Straight pieces beside the edges and true arcs about the corners, each with the solid on its left; the
/// last piece of a lap ends where its first begins.
using Lap = std::vector<PathPiece>;

/// All laps of the ground, in the order of its edges. O(n^2) for n walls and arcs.
std::vector<Lap> laps_of(const PolygonGround& ground);

/// The same lap begun at that piece.
Lap begun_at(const Lap& lap, std::size_t piece);
/// The same lap the other way round.
Lap turned_round(const Lap& lap);

}  // namespace outrider::cover
