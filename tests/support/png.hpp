// PNG files of a few pixels.
#pragma once

#include <png.h>

#include <string>
#include <vector>

namespace outrider::test {

/// A PNG of these pixels, grey ones unless told; what libpng itself makes of linear or of sRGB numbers.
template <class Number>
std::string png_of(int width, int height, const std::vector<Number>& pixels,
                   png_uint_32 format = sizeof(Number) == 2 ? PNG_FORMAT_LINEAR_Y : PNG_FORMAT_GRAY) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  image.width = static_cast<png_uint_32>(width);
  image.height = static_cast<png_uint_32>(height);
  image.format = format;
  png_alloc_size_t size = 0;
  png_image_write_to_memory(&image, nullptr, &size, 0, pixels.data(), 0, nullptr);
  std::string bytes(size, '\0');
  png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels.data(), 0, nullptr);
  bytes.resize(size);
  return bytes;
}

}  // namespace outrider::test
