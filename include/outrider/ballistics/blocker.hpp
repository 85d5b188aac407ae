// Blockers: convex pieces of solids as obstacles to flights, and a sweep that finds the relevant ones for
// each place.
//
// A flight stays in the vertical plane through the gun and the aim point. So a solid matters only if its
// footprint, grown by the ball and the margin, meets the line of sight on the ground. The places from which
// it does form a cone behind the solid, seen from the target. A row of the grid cuts the cone in one
// interval, so a sweep along the row yields the few blockers of each place.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "outrider/ballistics/contact.hpp"
#include "outrider/world/grid.hpp"

namespace outrider {

/// A convex piece of a solid as an obstacle to flights. For an upright prism, footprint x [low, high], the
/// polygons `side` and `core` bound it from inside; otherwise they are empty.
struct Blocker {
  Solid piece;
  std::size_t solid = 0;   ///< index in the FlightSpace
  std::vector<Vec2> hull;  ///< contains the footprint grown by ball and margin; empty for a half-space
  std::vector<Vec2> side;  ///< contained in the footprint grown by ball and margin
  std::vector<Vec2> core;  ///< contained in the footprint
  double low_m = 0.0;      ///< lowest height of the piece itself
  double high_m = 0.0;     ///< highest height of the piece itself
};

/// Returns all pieces of all solids, in their order. `grow_m` is the radius of the ball plus the margin.
std::vector<Blocker> blockers(const FlightSpace& space, double grow_m);

/// Visits each standable cell whose centre is within `reach_m` of `centre`, row by row, with the blockers
/// whose hull, grown by `spare_m`, may cross the line from the cell to `centre`. The visit returns false to
/// end the sweep.
void sweep(const std::vector<Blocker>& all, Vec2 centre, double reach_m, double spare_m,
           const GridFrame& frame, const std::vector<std::uint8_t>& standable,
           const std::function<bool(std::size_t cell, const std::vector<const Blocker*>& near)>& visit);

}  // namespace outrider
