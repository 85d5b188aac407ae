// PngReader: what libpng holds of a picture while it is read, freed however we leave.
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
