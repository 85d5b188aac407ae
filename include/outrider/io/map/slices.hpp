// Slices: the cut of a horizontal plane through a world, as text with one piece per line, in m.
//
//   x0,y0,x1,y1                     a wall without thickness
//   model,link,x0,y0,x1,y1,...      a convex polygon (at least 3 corners, either orientation) or such a wall
//
// Empty lines and lines that begin with # are skipped. Faults: bad_input with file:line, for numbers that are
// invalid or beyond 1e6 m, an odd number of coordinates, a piece with one corner, and a polygon that is not
// convex (by more than 1 mm).
// Bounds: 64 MiB, 200,000 pieces of at most 1000 corners.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/geometry/vec.hpp"

namespace outrider {

struct WorldSlice {
  std::string name;           ///< "model/link", or empty
  std::vector<Vec2> corners;  ///< two, or a convex polygon, counter-clockwise
};

Outcome<std::vector<WorldSlice>> load_slices(const std::string& path);
Outcome<std::vector<WorldSlice>> slices_from_text(std::string_view text, const std::string& name);

}  // namespace outrider
