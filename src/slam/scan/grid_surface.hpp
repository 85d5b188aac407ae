// The surfaces of an occupancy map: the points where occupied cells border on free ones.
//
// A point is the centre of an occupied cell, moved onto the line through the occupied cells around it: so a
// wall is where most readings were from which the map was made. A wall that is filled 0.2 m deep was drawn,
// and its points are on the edges of its cells. A cell with free cells on both sides of that line, as in a
// thin wall, gives a point for each side. Where the cells around show no line, the normal is unknown.
#pragma once

#include <cstdint>

#include "outrider/world/grid.hpp"
#include "scan/surface.hpp"

namespace outrider {

/// Returns the surfaces, with normals towards free cells. `occupancy` holds values of Occupancy. O(cells).
Surface surface_of(const Grid<std::uint8_t>& occupancy);

}  // namespace outrider
