#include "height_image.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdint>

#include "image.hpp"
#include "outrider/world/height_field.hpp"

namespace outrider {
namespace {

constexpr std::size_t signature_bytes = 8;
constexpr std::size_t frame_bytes = 12;  // length, name and checksum of a chunk

/// Removes the chunks that relate the values of the file to light, because libpng would convert the values.
std::string without_colours(std::string_view bytes) {
  std::string kept(bytes.substr(0, signature_bytes));
  for (std::size_t at = signature_bytes; at + frame_bytes <= bytes.size();) {
    std::size_t length = frame_bytes;
    for (std::size_t i = 0; i < 4; ++i) {
      length += static_cast<std::size_t>(static_cast<unsigned char>(bytes[at + i])) << (8 * (3 - i));
    }
    const std::string_view name = bytes.substr(at + 4, 4);
    if (name != "gAMA" && name != "sRGB" && name != "iCCP" && name != "cHRM")
      kept += bytes.substr(at, length);
    at += std::min(length, bytes.size() - at);
  }
  return kept;
}

/// Reads the pixels as two integers, the height and how opaque it is, and scales them to 1 for white. Refuses
/// pixels that one can see through.
template <class Number>
Outcome<std::vector<double>> read_pixels(PngReader& png, std::uint32_t format, const std::string& name) {
  constexpr auto white = static_cast<Number>(-1);
  png.header.format = format;
  std::vector<std::array<Number, 2>> pixels(std::size_t{png.header.width} * png.header.height);
  if (png_image_finish_read(&png.header, nullptr, pixels.data(), 0, nullptr) == 0) {
    return bad_input(fmt::format("libpng refuses it: {}", png.header.message), name);
  }
  std::vector<double> values;
  values.reserve(pixels.size());
  for (const auto& pixel : pixels) {
    if (pixel.back() != white) {
      return bad_input("pixels of it are transparent, and every height must be known; save it as grey", name);
    }
    values.push_back(static_cast<double>(pixel.front()) / static_cast<double>(white));
  }
  return values;
}

}  // namespace

Outcome<HeightImage> height_image_from_png(std::string_view bytes, const std::string& name) {
  const std::string plain = without_colours(bytes);
  PngReader png;
  if (png_image_begin_read_from_memory(&png.header, plain.data(), plain.size()) == 0) {
    return bad_input(fmt::format("libpng refuses it: {}", png.header.message), name);
  }
  if (auto size = HeightField::check_size(png.header.width, png.header.height); !size) {
    return bad_input(size.error().sentence, name);
  }
  const bool wide = (png.header.format & PNG_FORMAT_FLAG_LINEAR) != 0;
  auto values = wide ? read_pixels<std::uint16_t>(png, PNG_FORMAT_LINEAR_Y_ALPHA, name)
                     : read_pixels<std::uint8_t>(png, PNG_FORMAT_GA, name);
  if (!values) return pass_on(values);
  return HeightImage{static_cast<int>(png.header.width), static_cast<int>(png.header.height),
                     std::move(*values)};
}

}  // namespace outrider
