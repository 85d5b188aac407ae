// CameraImage: a grey image, and PixelBox: a rectangle of pixels.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace outrider {

struct CameraImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> values;  ///< row by row from the top, 0 black to 255 white

  [[nodiscard]] std::uint8_t& at(int x, int y) { return values[index(x, y)]; }
  [[nodiscard]] std::uint8_t at(int x, int y) const { return values[index(x, y)]; }

  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
};

/// The pixels with left <= x < right and top <= y < bottom.
struct PixelBox {
  int left = 0;
  int top = 0;
  int right = 0;
  int bottom = 0;

  [[nodiscard]] bool empty() const { return left >= right || top >= bottom; }
  friend bool operator==(const PixelBox&, const PixelBox&) = default;
};

}  // namespace outrider
