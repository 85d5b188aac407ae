// Grey images: reads PGM (P2, P5) and PNG, writes PGM. Sides up to 100,000 and 100 million pixels.
#pragma once

#include <png.h>
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

/// Owns the state of libpng while an image is read or written.
struct PngReader {
  png_image header{};

  PngReader() { header.version = PNG_IMAGE_VERSION; }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;
  ~PngReader() { png_image_free(&header); }
};

/// Returns true if the bytes begin like a PGM or a PNG.
bool is_image(std::string_view bytes);

/// Refuses an image without pixels, and one with more than are read.
Status check_image_size(std::size_t width, std::size_t height, const std::string& name);

/// Reads an image; the format is detected by the first bytes. 16-bit values are scaled to 8 bits, and colours
/// are averaged. `name` is for faults.
Outcome<GreyImage> image_from_bytes(std::string_view bytes, const std::string& name);

/// Refuses an image of more than 16 million pixels that has more than so many for each of its bytes: what is
/// done with it takes time and memory by its pixels.
Status check_expansion(std::size_t pixels, std::size_t bytes, std::size_t most_per_byte,
                       const std::string& name);

std::string to_pgm(const GreyImage& image);

}  // namespace outrider
