// Line of sight between two vertices of a grid: whether the straight leg is legal in its model.
//
// Integers only, so exact: the walk visits the cells that the leg crosses (cells: touches), one after
// another, by the sign of a cross product. O(|dx| + |dy|). Both vertices are places; whether they are
// pinches is not asked. Source: Amanatides and Woo (1987), with exact ties.
#pragma once

#include "outrider/path/grid/grid_map.hpp"

namespace outrider {

bool visible(const GridMap& ground, Cell from, Cell to);

}  // namespace outrider
