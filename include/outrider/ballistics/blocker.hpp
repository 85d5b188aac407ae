// Blockers: convex pieces of solids as obstacles to flights, and which of them matter from where.
//
// A flight stays in the vertical plane through the gun and the aim point. A solid matters only when
// its footprint, grown by the ball and the margin, meets the line of sight on the ground. Seen from
// the target those places form a cone behind the solid; a row of the grid cuts it in one interval, so
// a sweep along the row tells each place its few blockers.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "outrider/ballistics/contact.hpp"
#include "outrider/world/grid.hpp"

namespace outrider {

/// A convex piece of a solid as an obstacle to flights. Where piece = footprint x [low, high], polygons
/// tell what surely touches it; else `core` and `side` are empty.
struct Blocker {
  Solid piece;
  std::size_t solid = 0;   ///< index in the FlightSpace
  std::vector<Vec2> hull;  ///< around the footprint grown by ball and margin
  std::vector<Vec2> side;  ///< in the footprint grown by ball and margin
  std::vector<Vec2> core;  ///< in the footprint
  double low_m = 0.0;      ///< heights of the piece itself
  double high_m = 0.0;
};

/// All pieces of all solids, in their order; hulls and heights as above, for a ball and margin of `grow_m`.
std::vector<Blocker> blockers(const FlightSpace& space, double grow_m);

/// Visits each standable cell whose centre is within `reach_m` of `centre`, row by row, with the
/// blockers whose hull, grown by `spare_m`, the line from there to `centre` may cross. The visit
/// returns false to end the sweep.
void sweep(const std::vector<Blocker>& all, Vec2 centre, double reach_m, double spare_m,
           const GridFrame& frame, const std::vector<std::uint8_t>& standable,
           const std::function<bool(std::size_t cell, const std::vector<const Blocker*>& near)>& visit);

}  // namespace outrider
