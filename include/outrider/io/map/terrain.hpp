// Terrain: height fields from ESRI ASCII grids and from grey images.
//
// ESRI ASCII grid: the lines `ncols n`, `nrows n`, `xllcorner x` and `yllcorner y` (or `xllcenter`,
// `yllcenter`), `cellsize m` and optionally `NODATA_value v`, in any order and case; then the heights in m,
// beginning with the row of the highest y. Each cell is a post at its centre, so the field is half a cell
// smaller on each side.
//
// PNG with 8 or 16 bits: each pixel is a post, and the first row has the highest y. Black is the lowest
// height and white is the full size above it. Colour information in the file (such as gamma) is ignored,
// because the values are heights.
//
// Faults: bad_input with file:line or the file, for an incomplete or wrong header, an invalid number, a cell
// without data, a wrong count, transparency, and more than HeightField::most_posts (checked before memory is
// allocated). O(length of the file).
#pragma once

#include <string>
#include <string_view>

#include "outrider/core/outcome.hpp"
#include "outrider/world/height_field.hpp"

namespace outrider {

/// Reads an ESRI ASCII grid.
Outcome<HeightField> terrain_from_grid(std::string_view text, const std::string& name);

/// Reads a PNG. `middle` is the centre of the image and the height of black. `size` is the distance between
/// the outer pixels along x and y, and the height of white above black.
Outcome<HeightField> terrain_from_png(std::string_view bytes, const std::string& name, Vec3 middle,
                                      Vec3 size);

/// Loads a terrain; the format is detected by the first bytes. `size` and `position` are for images; a grid
/// states its own, so they must be empty for it.
Outcome<HeightField> load_terrain(const std::string& path, const std::string& size,
                                  const std::string& position);

}  // namespace outrider
