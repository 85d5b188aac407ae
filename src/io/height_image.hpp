// Reads heights from grey PNG images.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "outrider/core/outcome.hpp"

namespace outrider {

struct HeightImage {
  int width = 0;
  int height = 0;
  std::vector<double> values;  ///< row by row from the top, 0 black to 1 white, without gamma
};

/// Reads a PNG with 8 or 16 bits per pixel; colours become grey. Refuses pixels that are not opaque, and
/// images that are too large for a height field.
Outcome<HeightImage> height_image_from_png(std::string_view bytes, const std::string& name);

}  // namespace outrider
