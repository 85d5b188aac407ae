#include "map/image.hpp"

#include <fmt/format.h>

#include <optional>

#include "outrider/io/files/text.hpp"

namespace outrider {
namespace {

/// Reads the next number of a PGM header or of P2 pixels; comments go from '#' to the end of the line.
std::optional<unsigned> pgm_number(std::string_view& rest) {
  for (;;) {
    rest.remove_prefix(std::min(rest.find_first_not_of(white_space), rest.size()));
    if (!rest.starts_with('#')) break;
    take_line(rest);
  }
  const std::string_view digits = rest.substr(0, rest.find_first_not_of("0123456789"));
  rest.remove_prefix(digits.size());
  return number<unsigned>(digits);
}

struct PgmHeader {
  bool text = false;
  std::size_t width = 0;
  std::size_t height = 0;
  unsigned white = 255;
};

Outcome<PgmHeader> pgm_header(std::string_view& rest, const std::string& name) {
  PgmHeader header;
  header.text = rest.starts_with("P2");
  rest.remove_prefix(2);
  const auto width = pgm_number(rest);
  const auto height = pgm_number(rest);
  const auto white = pgm_number(rest);
  if (!width || !height || !white || *white < 1 || *white > 65535 || rest.empty()) {
    return bad_input("its PGM header is damaged; it is P5 (or P2), width, height and 1 to 65535", name);
  }
  rest.remove_prefix(1);  // one white-space character ends the header
  header.width = *width;
  header.height = *height;
  header.white = *white;
  if (auto size = check_image_size(header.width, header.height, name); !size) return pass_on(size);
  const std::size_t pixels = header.width * header.height;
  const std::size_t least = header.text ? 2 * pixels - 1 : pixels * (header.white > 255 ? 2 : 1);
  if (rest.size() < least) {
    return bad_input(fmt::format("it is cut short: {} x {} pixels take at least {} bytes, {} are there",
                                 header.width, header.height, least, rest.size()),
                     name);
  }
  return header;
}

Outcome<GreyImage> from_pgm(std::string_view bytes, const std::string& name) {
  auto header = pgm_header(bytes, name);
  if (!header) return pass_on(header);
  GreyImage image{static_cast<int>(header->width), static_cast<int>(header->height), {}, {}};
  image.values.reserve(header->width * header->height);
  const bool wide = header->white > 255;
  const auto byte = [&](std::size_t i) {
    return static_cast<unsigned>(static_cast<unsigned char>(bytes[i]));
  };
  for (std::size_t i = 0; i < header->width * header->height; ++i) {
    std::optional<unsigned> value;
    if (header->text) {
      value = pgm_number(bytes);
    } else {
      value = wide ? byte(2 * i) << 8 | byte(2 * i + 1) : byte(i);
    }
    if (!value || *value > header->white) {
      return bad_input(fmt::format("pixel {} is missing or above the header's {}", i, header->white), name);
    }
    image.values.push_back(
        static_cast<std::uint8_t>((2 * *value * 255 + header->white) / (2 * header->white)));
  }
  return image;
}

Outcome<GreyImage> from_png(std::string_view bytes, const std::string& name) {
  PngReader png;
  const auto damaged = [&] {
    return bad_input(fmt::format("libpng refuses it: {}", png.header.message), name);
  };
  if (png_image_begin_read_from_memory(&png.header, bytes.data(), bytes.size()) == 0) return damaged();
  if (auto size = check_image_size(png.header.width, png.header.height, name); !size) return pass_on(size);
  constexpr std::size_t most_pixels_per_byte = std::size_t{8} * 1032;  // 1 bit per pixel, best deflate ratio
  if (std::size_t{png.header.width} * png.header.height > most_pixels_per_byte * bytes.size()) {
    return bad_input("it is cut short: its header names more pixels than its bytes can hold", name);
  }
  constexpr std::size_t usual_pixels_per_byte = 250;
  if (auto size = check_expansion(std::size_t{png.header.width} * png.header.height, bytes.size(),
                                  usual_pixels_per_byte, name);
      !size)
    return pass_on(size);
  png.header.format = PNG_FORMAT_RGBA;
  png.header.flags |= PNG_IMAGE_FLAG_16BIT_sRGB;
  std::vector<std::uint8_t> rgba(PNG_IMAGE_SIZE(png.header));
  if (png_image_finish_read(&png.header, nullptr, rgba.data(), 0, nullptr) == 0) return damaged();
  const std::size_t pixels = rgba.size() / 4;
  GreyImage image{static_cast<int>(png.header.width), static_cast<int>(png.header.height),
                  std::vector<std::uint8_t>(pixels), std::vector<bool>(pixels)};
  for (std::size_t i = 0; i < pixels; ++i) {
    const int sum = rgba[4 * i] + rgba[4 * i + 1] + rgba[4 * i + 2];
    image.values[i] = static_cast<std::uint8_t>((sum + 1) / 3);
    image.transparent[i] = rgba[4 * i + 3] == 0;
  }
  return image;
}

}  // namespace

bool is_image(std::string_view bytes) {
  if (bytes.starts_with("\x89PNG")) return true;
  const bool grey = bytes.starts_with("P2") || bytes.starts_with("P5");
  return grey && bytes.size() > 2 && (white_space.find(bytes[2]) != bytes.npos || bytes[2] == '#');
}

Status check_image_size(std::size_t width, std::size_t height, const std::string& name) {
  constexpr std::size_t longest_side = 100'000, most_pixels = 100'000'000;
  if (width >= 1 && height >= 1 && std::max(width, height) <= longest_side && width * height <= most_pixels)
    return {};
  return bad_input(
      fmt::format("an image of {} x {} pixels is not read; sides go from 1 to {} and pixels to {}", width,
                  height, longest_side, most_pixels),
      name);
}

Outcome<GreyImage> image_from_bytes(std::string_view bytes, const std::string& name) {
  if (!is_image(bytes))
    return bad_input("it is neither PGM (P2, P5) nor PNG; convert it to one of them", name);
  return bytes.starts_with('P') ? from_pgm(bytes, name) : from_png(bytes, name);
}

Status check_expansion(std::size_t pixels, std::size_t bytes, std::size_t most_per_byte,
                       const std::string& name) {
  constexpr std::size_t any = std::size_t{16} << 20U;
  if (pixels <= any || pixels / most_per_byte <= bytes) return {};
  return bad_input(fmt::format("its {} bytes stand for {} pixels, more than {} each; save it as PGM", bytes,
                               pixels, most_per_byte),
                   name);
}

std::string to_pgm(const GreyImage& image) {
  std::string bytes = fmt::format("P5\n{} {}\n255\n", image.width, image.height);
  bytes.append(image.values.begin(), image.values.end());
  return bytes;
}

}  // namespace outrider
