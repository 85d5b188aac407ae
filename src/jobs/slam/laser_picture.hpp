// A picture of an occupancy map with the track of the robot.
#pragma once

#include <string>
#include <vector>

#include "outrider/world/grid.hpp"

namespace outrider {

/// Returns the smallest part of a map that contains all known cells; one cell if there are none.
Grid<std::uint8_t> known_part(const Grid<std::uint8_t>& occupancy);

/// Returns an SVG with occupied and free cells, the track, and a reference in the same frame if there is one.
std::string to_svg(const Grid<std::uint8_t>& occupancy, const std::vector<Vec2>& track,
                   const std::vector<Vec2>& reference);

}  // namespace outrider
