// Line of sight between two vertices of a grid.
//
// The test uses integers only, so it is exact: it visits the cells that the leg crosses (in the model
// `cells`: touches) one after another, by the sign of a cross product. O(|dx| + |dy|). Source: Amanatides and
// Woo (1987), with exact ties.
#pragma once

#include "outrider/path/grid/grid_map.hpp"

namespace outrider {

/// Returns true if the straight leg is legal in the model of the grid. A path must be able to start or end at
/// both vertices (GridMap::place()). Either vertex may be a pinch.
bool visible(const GridMap& ground, Cell from, Cell to);

}  // namespace outrider
