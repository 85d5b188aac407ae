// An occupancy map with the track of the robot on it, drawn.
#pragma once

#include <string>
#include <vector>

#include "outrider/world/grid.hpp"

namespace outrider {

/// The smallest part of a map that has all known cells; one cell where there is none.
Grid<std::uint8_t> known_part(const Grid<std::uint8_t>& occupancy);

/// SVG: occupied and free cells, the track, and a reference of the same frame where there is one.
std::string to_svg(const Grid<std::uint8_t>& occupancy, const std::vector<Vec2>& track,
                   const std::vector<Vec2>& reference);

}  // namespace outrider
