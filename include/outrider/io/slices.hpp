// Slices: what a horizontal plane cuts of a world, as text, one piece a line, in m.
//
//   x0,y0,x1,y1                     a wall without thickness
//   model,link,x0,y0,x1,y1,...      a convex polygon of at least 3 corners, either way round, or such a wall
//
// Empty lines and what begins with # are left out. Faults: bad_input with file:line: numbers that are none or
// beyond 1e6 m, half a corner, a piece of one corner, a polygon that is not convex (by more than 1 mm).
// Bounds: 64 MiB, 200,000 pieces of at most 1000 corners.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/world/solid.hpp"

namespace outrider {

struct WorldSlice {
  std::string name;           ///< "model/link", or empty
  std::vector<Vec2> corners;  ///< two, or a convex polygon, counter-clockwise
};

Outcome<std::vector<WorldSlice>> load_slices(const std::string& path);
Outcome<std::vector<WorldSlice>> slices_from_text(std::string_view text, const std::string& name);

/// The slice as a solid between two heights. A wall is a box without thickness and a rectangle a box, whose
/// corners are within 0.2 mm of those given; any other polygon is the mesh of its sides and of a floor 15
/// cm above its foot.
Solid upright(const WorldSlice& slice, const std::string& name, double z_low_m, double z_high_m);

}  // namespace outrider
