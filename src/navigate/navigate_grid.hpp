// Distances from the middles of cells to the nearest of some places; points on edges.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "outrider/geometry/convex.hpp"
#include "outrider/world/grid.hpp"

namespace outrider {

inline constexpr std::array<Cell, 8> neighbours = {
    {{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};

/// Sets `distance_m` to the distance from the middle of each cell to the nearest place, at most `most_m`.
/// Exact; O(cells + places * cells within most_m).
void spread_distances(const GridFrame& frame, const std::vector<Vec2>& places, double most_m,
                      std::vector<float>& distance_m);

/// Adds points on an edge, its ends among them, at most `apart_m` from each other.
void add_points(Segment edge, double apart_m, std::vector<Vec2>& points);

}  // namespace outrider
