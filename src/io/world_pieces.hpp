// Adds solids to a world, up to the maximum number.
#pragma once

#include <string>
#include <vector>

#include "outrider/io/slices.hpp"
#include "outrider/world/world.hpp"

namespace outrider {

/// Adds a solid. Fault: bad_input with `where` if the world has the maximum number.
Status add_solid(World& world, Solid solid, const std::string& where);

/// Adds slices as solids that stand on the floor.
Status add_slices(World& world, const std::vector<WorldSlice>& slices, double height_m,
                  const std::string& where);

}  // namespace outrider
