// PngReader: owns the state of libpng while an image is read or written.
#pragma once

#include <png.h>

namespace outrider {

struct PngReader {
  png_image header{};
  PngReader() { header.version = PNG_IMAGE_VERSION; }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;
  ~PngReader() { png_image_free(&header); }
};

}  // namespace outrider
