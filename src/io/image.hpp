// Grey images: reads PGM (P2, P5) and PNG, writes PGM.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/core/outcome.hpp"

namespace outrider {

struct GreyImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> values;  ///< row by row from the top, 0 black to 255 white
  std::vector<bool> transparent;     ///< empty if no pixel is transparent
};

/// Reads an image; the format is detected by the first bytes. 16-bit values are scaled to 8 bits, and colours
/// are averaged. `name` is for faults.
Outcome<GreyImage> image_from_bytes(std::string_view bytes, const std::string& name);

/// Refuses an image of more than 16 million pixels that has more than so many for each of its bytes: what is
/// done with it takes time and memory by its pixels.
Status check_expansion(std::size_t pixels, std::size_t bytes, std::size_t most_per_byte,
                       const std::string& name);

std::string to_pgm(const GreyImage& image);

}  // namespace outrider
