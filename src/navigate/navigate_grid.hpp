// Distances from the middles of cells to the nearest of some places.
#pragma once

#include <vector>

#include "outrider/world/grid.hpp"

namespace outrider {

/// Sets `distance_m` to the distance from the middle of each cell to the nearest place, at most `most_m`.
/// Exact; O(cells + places * cells within most_m).
void spread_distances(const GridFrame& frame, const std::vector<Vec2>& places, double most_m,
                      std::vector<float>& distance_m);

}  // namespace outrider
