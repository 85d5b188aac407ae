#include "outrider/io/map/terrain.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include "map/image.hpp"
#include "outrider/io/files/files.hpp"
#include "outrider/io/files/text.hpp"
#include "outrider/io/scenario/values.hpp"

namespace outrider {
namespace {

constexpr double largest_size_m = 1e6;

struct GridHeader {
  int columns = 0;
  int rows = 0;
  Vec2 first;  ///< centre of the cell with the lowest x and y
  double cell_m = 0.0;
  std::optional<double> no_data;
};

/// Reads the words before the heights. After that, `lines.line` is the first line of heights.
Outcome<std::map<std::string, double>> header_fields(TextLines& lines) {
  std::map<std::string, double> words_of_header;
  while (lines.next()) {
    std::string_view rest = lines.line;
    const std::string_view word = take_word(rest);
    if (word.empty()) continue;
    if (std::isalpha(static_cast<unsigned char>(word.front())) == 0) return words_of_header;
    const std::string_view text = take_word(rest);
    const auto value = number<double>(text);
    if (!value || !take_word(rest).empty()) {
      return bad_input(fmt::format("'{}' takes one number, such as {} 100", excerpt(word), excerpt(word)),
                       lines.where());
    }
    if (!words_of_header.emplace(lower(word), *value).second) {
      return bad_input(fmt::format("'{}' is given twice; leave one", excerpt(word)), lines.where());
    }
  }
  lines.line = {};
  return words_of_header;
}

Outcome<GridHeader> header_of(TextLines& lines) {
  auto known = header_fields(lines);
  if (!known) return pass_on(known);
  const auto find = [&](const char* key) -> std::optional<double> {
    const auto found = known->find(key);
    return found == known->end() ? std::nullopt : std::optional(found->second);
  };
  const auto columns = find("ncols");
  const auto rows = find("nrows");
  const auto cell = find("cellsize");
  const auto x = find("xllcorner") ? find("xllcorner") : find("xllcenter");
  const auto y = find("yllcorner") ? find("yllcorner") : find("yllcenter");
  if (!columns || !rows || !cell || !x || !y) {
    return bad_input("its header is incomplete; expected ncols, nrows, xllcorner, yllcorner and cellsize",
                     lines.name);
  }
  if (*columns != std::floor(*columns) || *rows != std::floor(*rows)) {
    return bad_input(fmt::format("{:g} x {:g} cells is not valid; these are whole numbers", *columns, *rows),
                     lines.name);
  }
  if (auto size = HeightField::check_size(*columns, *rows); !size) {
    return bad_input(size.error().sentence, lines.name);
  }
  if (!(*cell > 0.0) || *cell > largest_size_m) {
    return bad_input(fmt::format("a cellsize of {:g} is not valid; it is above 0 and at most 1e6 m", *cell),
                     lines.name);
  }
  const Vec2 half{find("xllcorner") ? 0.5 * *cell : 0.0, find("yllcorner") ? 0.5 * *cell : 0.0};
  return GridHeader{static_cast<int>(*columns), static_cast<int>(*rows), Vec2{*x, *y} + half, *cell,
                    find("nodata_value")};
}

Outcome<std::vector<double>> heights_of(TextLines& lines, const GridHeader& header) {
  const auto columns = static_cast<std::size_t>(header.columns);
  const std::size_t count = columns * static_cast<std::size_t>(header.rows);
  std::vector<double> heights(count);
  std::size_t read = 0;
  do {
    for (std::string_view rest = lines.line, word = take_word(rest); !word.empty(); word = take_word(rest)) {
      const auto height = number<double>(word);
      if (!height || *height == header.no_data) {
        return bad_input(fmt::format("'{}' in column {} of row {} is no height; every cell takes one, in m",
                                     excerpt(word), read % columns + 1, read / columns + 1),
                         lines.where());
      }
      if (read == count) {
        return bad_input(
            fmt::format("more than the {} x {} heights of the header", header.columns, header.rows),
            lines.where());
      }
      const std::size_t row = static_cast<std::size_t>(header.rows) - 1 - read / columns;
      heights[row * columns + read % columns] = *height;
      ++read;
    }
  } while (lines.next());
  if (read < count) {
    return bad_input(
        fmt::format("it ends after {} heights; its header says {} x {}", read, header.columns, header.rows),
        lines.name);
  }
  return heights;
}

// ---- Images --------------------------------------------------------------------------------------

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

Outcome<HeightField> terrain_from_grid(std::string_view text, const std::string& name) {
  TextLines lines{text, name};
  auto header = header_of(lines);
  if (!header) return pass_on(header);
  auto heights = heights_of(lines, *header);
  if (!heights) return pass_on(heights);
  auto field = HeightField::make(header->first, {header->cell_m, header->cell_m}, header->columns,
                                 header->rows, std::move(*heights));
  if (!field) return bad_input(field.error().sentence, name);
  return field;
}

Outcome<HeightField> terrain_from_png(std::string_view bytes, const std::string& name, Vec3 middle,
                                      Vec3 size) {
  const auto is_size = [](double m) { return m > 0.0 && m <= largest_size_m; };
  if (!is_size(size.x) || !is_size(size.y) || !(std::abs(size.z) <= largest_size_m)) {
    return bad_input(
        fmt::format("a size of {:g} x {:g} x {:g} m is not valid; length and width are above 0, and "
                    "all at most 1e6 m",
                    size.x, size.y, size.z),
        name);
  }
  const std::string plain = without_colours(bytes);
  PngReader png;
  if (png_image_begin_read_from_memory(&png.header, plain.data(), plain.size()) == 0)
    return bad_input(fmt::format("libpng refuses it: {}", png.header.message), name);
  const std::size_t columns = png.header.width, rows = png.header.height;
  if (auto ok = HeightField::check_size(png.header.width, png.header.height); !ok)
    return bad_input(ok.error().sentence, name);
  const bool wide = (png.header.format & PNG_FORMAT_FLAG_LINEAR) != 0;
  auto values = wide ? read_pixels<std::uint16_t>(png, PNG_FORMAT_LINEAR_Y_ALPHA, name)
                     : read_pixels<std::uint8_t>(png, PNG_FORMAT_GA, name);
  if (!values) return pass_on(values);
  std::vector<double> heights(values->size());
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const std::size_t row = rows - 1 - i / columns;
    heights[row * columns + i % columns] = middle.z + size.z * (*values)[i];
  }
  const int width = static_cast<int>(columns), height = static_cast<int>(rows);
  auto field = HeightField::make(xy(middle) - 0.5 * xy(size), {size.x / (width - 1), size.y / (height - 1)},
                                 width, height, std::move(heights));
  if (!field) return bad_input(field.error().sentence, name);
  return field;
}

Outcome<HeightField> load_terrain(const std::string& path, const std::string& size,
                                  const std::string& position) {
  auto bytes = read_file(path);
  if (!bytes) return pass_on(bytes);
  if (!bytes->starts_with("\x89PNG")) {
    if (!size.empty() || !position.empty()) {
      return bad_input("a grid says itself where it lies and how large it is; leave this out",
                       size.empty() ? "terrain_position" : "terrain_size");
    }
    return terrain_from_grid(*bytes, path);
  }
  if (size.empty()) {
    return bad_input("an image does not say how large it is; give length,width,height in m, such as 20,20,2",
                     "terrain_size");
  }
  auto extent = parse_numbers(size, 3, "terrain_size", "length,width,height in m, such as 20,20,2");
  if (!extent) return pass_on(extent);
  auto middle = parse_numbers(position.empty() ? "0,0,0" : position, 3, "terrain_position",
                              "x,y,z of the middle of the image at black, m, such as 0,0,0");
  if (!middle) return pass_on(middle);
  return terrain_from_png(*bytes, path, {(*middle)[0], (*middle)[1], (*middle)[2]},
                          {(*extent)[0], (*extent)[1], (*extent)[2]});
}

}  // namespace outrider
