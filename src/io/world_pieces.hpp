// Solids that are put into a world one by one, as many as one may hold.
#pragma once

#include <string>
#include <vector>

#include "outrider/io/slices.hpp"
#include "outrider/world/world.hpp"

namespace outrider {

/// Fault: bad_input at `where` when the world is full.
Status add_solid(World& world, Solid solid, const std::string& where);

/// Stands the slices on the floor.
Status add_slices(World& world, const std::vector<WorldSlice>& slices, double height_m,
                  const std::string& where);

}  // namespace outrider
