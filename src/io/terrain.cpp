#include "outrider/io/terrain.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <optional>
#include <vector>

#include "height_image.hpp"
#include "outrider/io/files.hpp"
#include "outrider/io/text.hpp"
#include "outrider/io/values.hpp"

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
  auto image = height_image_from_png(bytes, name);
  if (!image) return pass_on(image);
  std::vector<double> heights(image->values.size());
  const auto columns = static_cast<std::size_t>(image->width);
  const auto rows = static_cast<std::size_t>(image->height);
  for (std::size_t i = 0; i < heights.size(); ++i) {
    const std::size_t row = rows - 1 - i / columns;
    heights[row * columns + i % columns] = middle.z + size.z * image->values[i];
  }
  auto field = HeightField::make(xy(middle) - 0.5 * xy(size),
                                 {size.x / (image->width - 1), size.y / (image->height - 1)}, image->width,
                                 image->height, std::move(heights));
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
