// Simplifies polygons on the corners of cells so that they only lose area.
#pragma once

#include <vector>

#include "outrider/world/grid.hpp"

namespace outrider {

/// A closed polygon on the corners of cells, with the free space on its left.
using LatticeRing = std::vector<Cell>;

/// Cuts corners off, those of least error first, as long as every corner that was there at first lies within
/// `tolerance` cells of the edge that replaces it. The rings together bound a part of the plane; they must be
/// simple and touch neither themselves nor each other, and stay so.
std::vector<LatticeRing> cut_corners(const std::vector<LatticeRing>& rings, double tolerance);

}  // namespace outrider
