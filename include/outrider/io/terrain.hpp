// Terrain: height fields from ESRI ASCII grids and from grey images.
//
// ESRI ASCII grid: lines `ncols n`, `nrows n`, `xllcorner x` and `yllcorner y` (or `xllcenter`, `yllcenter`),
// `cellsize m` and perhaps `NODATA_value v`, in any order and case; then the heights in m, the row with the
// highest y first. Each cell is a post at its centre, so the field is half a cell smaller on each side.
//
// PNG of 8 or 16 bits: each pixel is a post, the first row that of the highest y; black is the lowest height
// and white lies a whole size above it. Heights are no light: what the file says of its colours is ignored.
//
// Errors: bad_input with file:line or the file: a header that is incomplete or lies, a number that is none,
// a cell without data, a wrong count, transparency, more than HeightField::most_posts (checked before
// anything is allocated). O(length of the file).
#pragma once

#include <string>
#include <string_view>

#include "outrider/core/outcome.hpp"
#include "outrider/world/height_field.hpp"

namespace outrider {

Outcome<HeightField> terrain_from_grid(std::string_view text, const std::string& name);

/// `middle` is the centre of the image and the height of black; `size` the way between its outer pixels,
/// along x and y, and from black to white.
Outcome<HeightField> terrain_from_png(std::string_view bytes, const std::string& name, Vec3 middle,
                                      Vec3 size);

/// Told by the first bytes. A grid says itself where it lies: with it, size and position are refused.
Outcome<HeightField> load_terrain(const std::string& path, const std::string& size,
                                  const std::string& position);

}  // namespace outrider
