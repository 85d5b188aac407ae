// FreeParts: the free space of a map of cells as polygons that stay inside it.
//
//   FreeParts parts = free_parts(reach_of_disk(map, radius_m));
//   FreeOutline outline = outline_of(parts, 0, tolerance_m);   // of the largest part
//
// The free space is what lies in free cells; what is occupied, unknown or beyond the map is not free. Two
// free cells are connected if they share a side. Where two free cells meet at a corner only, one of them is
// given up, so that no outline touches itself. Thread rule: pure functions.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "outrider/world/grid.hpp"

namespace outrider {

/// The connected parts of the free space.
struct FreeParts {
  Grid<std::int32_t> part;         ///< index of the part of each cell, or -1
  std::vector<std::size_t> cells;  ///< number of cells of each part, the largest first
};

/// A polygon with holes.
struct FreeOutline {
  std::vector<Vec2> boundary;            ///< counter-clockwise, in the frame of the map, m
  std::vector<std::vector<Vec2>> holes;  ///< clockwise
};

/// Returns the map with only those cells free that a disk touches while its centre moves where the disk lies
/// in free space, and a margin of about two cells: rays of a scan that left by a window, and gaps too
/// narrow for the disk, are gone. Nothing that the disk can touch is lost. O(cells). The map must have at
/// most 32766 cells on each side.
Grid<std::uint8_t> reach_of_disk(const Grid<std::uint8_t>& map, double radius_m);

/// Finds the parts; cells that are not 0 are not free. O(cells).
FreeParts free_parts(const Grid<std::uint8_t>& map);

/// Returns the outline of a part, simplified: each polygon is simple, touches no other, lies inside the free
/// space, and every point of the part lies in it or within `tolerance_m` of it. Corners are cut off, those of
/// least error first, never filled. O(n log n + n k) for n corners of cells with k corners near each.
FreeOutline outline_of(const FreeParts& parts, std::size_t part, double tolerance_m);

}  // namespace outrider
