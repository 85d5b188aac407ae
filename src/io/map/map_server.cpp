#include "outrider/io/map/map_server.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <optional>
#include <vector>

#include "files/yaml.hpp"
#include "map/image.hpp"
#include "outrider/io/files/files.hpp"

namespace outrider {
namespace {

namespace fs = std::filesystem;

constexpr double farthest_origin_m = 1e6;

struct MapKeys {
  std::string image;
  double resolution_m = 0.0;
  std::array<double, 3> origin{};  // x, y, yaw
  bool negate = false;
  double occupied_thresh = 0.65;
  double free_thresh = 0.196;
  std::string mode;
};

/// A key with a number.
struct NumberKey {
  const char* key;
  double low;
  double high;
  double* value;
  const char* right;
};

Outcome<MapKeys> map_keys(std::string_view text, const std::string& name) {
  const auto root = yaml_map(text, name);
  if (!root) return pass_on(root);
  const YAML::Node& map = *root;
  const auto refused = [&](const char* key, std::string_view right) {
    const YAML::Node node = map[key];
    return bad_input(node.IsDefined() ? fmt::format("'{}' is not valid; expected {}", key, right)
                                      : fmt::format("the key '{}' is missing; expected {}", key, right),
                     node.IsDefined() ? yaml_where(name, node) : name);
  };
  const auto text_of = [&](const char* key, const char* otherwise) {
    return map[key].IsDefined() ? yaml_text(map[key]).value_or("") : otherwise;
  };
  MapKeys keys;
  keys.image = text_of("image", "");
  if (keys.image.empty()) return refused("image", "the name of a PGM or PNG file");
  for (const auto& [key, low, high, value, right] :
       {NumberKey{"resolution", 1e-4, 1e3, &keys.resolution_m, "the side of a pixel in m, from 1e-4 to 1e3"},
        NumberKey{"occupied_thresh", 0.0, 1.0, &keys.occupied_thresh, "a number from 0 to 1"},
        NumberKey{"free_thresh", 0.0, 1.0, &keys.free_thresh, "a number from 0 to 1"}}) {
    if (map[key].IsDefined()) *value = yaml_number(map[key]).value_or(std::nan(""));
    if (!(*value >= low && *value <= high)) return refused(key, right);
  }
  if (keys.free_thresh > keys.occupied_thresh)
    return refused("free_thresh", "a number at most occupied_thresh");
  const auto origin = yaml_numbers(map["origin"]).value_or(std::vector<double>{});
  const auto is_far = [](double value) { return std::abs(value) > farthest_origin_m; };
  if (origin.size() < 2 || origin.size() > 3 || std::ranges::any_of(origin, is_far))
    return refused("origin", "[x, y, yaw], numbers from -1e6 to 1e6");
  std::ranges::copy(origin, keys.origin.begin());
  const std::string negate = text_of("negate", "0");
  keys.negate = negate == "1" || negate == "true";
  if (!keys.negate && negate != "0" && negate != "false") return refused("negate", "0 or 1");
  keys.mode = text_of("mode", "trinary");
  if (keys.mode != "trinary" && keys.mode != "scale" && keys.mode != "raw")
    return refused("mode", "trinary, scale or raw");
  return keys;
}

/// Returns the occupancy as a share of 1; nothing if it is unknown.
std::optional<double> share_of(std::uint8_t value, const MapKeys& keys) {
  const bool raw = keys.mode == "raw";
  if (raw && value > 100) return std::nullopt;
  const double shade = keys.negate ? value / 255.0 : (255 - value) / 255.0;
  return raw ? value / 100.0 : shade;
}

Occupancy occupancy_of(std::uint8_t value, const MapKeys& keys) {
  const auto p = share_of(value, keys);
  if (!p) return unknown_cell;
  if (*p > keys.occupied_thresh) return occupied_cell;
  return *p < keys.free_thresh ? free_cell : unknown_cell;
}

/// Returns the value of a pixel in percent, as map_server publishes it.
std::int8_t percent_of(std::uint8_t value, const MapKeys& keys) {
  const auto p = share_of(value, keys);
  if (!p) return -1;
  if (keys.mode == "raw") return static_cast<std::int8_t>(value);
  if (*p > keys.occupied_thresh) return 100;
  if (*p < keys.free_thresh) return 0;
  const double between = (*p - keys.free_thresh) / (keys.occupied_thresh - keys.free_thresh);
  return keys.mode == "scale" ? static_cast<std::int8_t>(std::lround(100.0 * between)) : std::int8_t{-1};
}

/// Returns the grey value that map_server writes.
std::uint8_t shade_of(std::uint8_t occupancy) {
  if (occupancy == free_cell) return 254;
  return occupancy == occupied_cell ? 0 : 205;
}

/// Fills a grid with what `value_of` makes of each pixel; a transparent one has the value `hidden`.
template <class T, class ValueOf>
Outcome<Grid<T>> grid_from_bytes(std::string_view bytes, const std::string& path, const MapKeys& keys,
                                 T hidden, ValueOf value_of) {
  auto image = image_from_bytes(bytes, path);
  if (!image) return pass_on(image);
  Grid<T> grid({{keys.origin[0], keys.origin[1]}, keys.resolution_m, image->width, image->height});
  for (std::size_t pixel = 0; pixel < image->values.size(); ++pixel) {
    const Cell from_top = grid.frame.cell(pixel);
    const bool is_hidden = !image->transparent.empty() && image->transparent[pixel];
    grid[{from_top.x, grid.frame.height - 1 - from_top.y}] =
        is_hidden ? hidden : static_cast<T>(value_of(image->values[pixel], keys));
  }
  return grid;
}

Outcome<MapServerMap> map_from_bytes(std::string_view bytes, const std::string& path, const MapKeys& keys) {
  auto grid = grid_from_bytes<std::uint8_t>(bytes, path, keys, unknown_cell, occupancy_of);
  if (!grid) return pass_on(grid);
  return MapServerMap{std::move(*grid), keys.origin[2]};
}

/// Reads the image that a YAML file of that name names.
Outcome<std::string> image_beside(const std::string& name, const MapKeys& keys, std::string& path) {
  path = (fs::path(name).parent_path() / keys.image).string();
  return read_file(path);
}

Status check_frame(const GridFrame& frame, const std::string& path) {
  const double far = std::max(std::abs(frame.origin.x), std::abs(frame.origin.y));
  if (frame.width >= 1 && frame.height >= 1 && frame.resolution_m > 0.0 &&
      std::isfinite(frame.resolution_m) && far <= farthest_origin_m) {
    return {};
  }
  return bad_input("an empty map, or one with no origin and resolution, is not written", path);
}

}  // namespace

Outcome<MapServerMap> load_map_server(const std::string& path) {
  auto text = read_file(path);
  if (!text) return pass_on(text);
  return map_server_from_text(*text, path);
}

Outcome<MapServerMap> map_server_from_text(std::string_view text, const std::string& name) {
  auto keys = map_keys(text, name);
  if (!keys) return pass_on(keys);
  std::string path;
  const auto bytes = image_beside(name, *keys, path);
  if (!bytes) return pass_on(bytes);
  return map_from_bytes(*bytes, path, *keys);
}

Outcome<MapServerValues> load_map_server_values(const std::string& path) {
  const auto text = read_file(path);
  if (!text) return pass_on(text);
  const auto keys = map_keys(*text, path);
  if (!keys) return pass_on(keys);
  std::string image;
  const auto bytes = image_beside(path, *keys, image);
  if (!bytes) return pass_on(bytes);
  auto grid = grid_from_bytes<std::int8_t>(*bytes, image, *keys, -1, percent_of);
  if (!grid) return pass_on(grid);
  return MapServerValues{std::move(*grid), keys->origin[2]};
}

Outcome<MapServerMap> map_image_from_bytes(std::string_view bytes, const std::string& name,
                                           double resolution_m) {
  MapKeys keys;
  keys.resolution_m = resolution_m;
  return map_from_bytes(bytes, name, keys);
}

Outcome<MapServerText> map_server_text(const MapServerMap& map, const std::string& image_name) {
  const GridFrame& frame = map.occupancy.frame;
  if (auto good = check_frame(frame, image_name); !good) return pass_on(good);
  GreyImage image{frame.width, frame.height, std::vector<std::uint8_t>(frame.size()), {}};
  for (std::size_t pixel = 0; pixel < frame.size(); ++pixel) {
    const Cell from_top = frame.cell(pixel);
    image.values[pixel] = shade_of(map.occupancy[{from_top.x, frame.height - 1 - from_top.y}]);
  }
  return MapServerText{
      fmt::format("image: {}\nresolution: {}\norigin: [{}, {}, {}]\nnegate: 0\n"
                  "occupied_thresh: 0.65\nfree_thresh: 0.196\n",
                  image_name, frame.resolution_m, frame.origin.x, frame.origin.y, map.yaw_rad),
      to_pgm(image)};
}

Status save_map_server(const std::string& path, const MapServerMap& map) {
  const fs::path image_path = fs::path(path).replace_extension(".pgm");
  if (image_path == fs::path(path)) return bad_input("the YAML file cannot end in .pgm; name it .yaml", path);
  auto text = map_server_text(map, image_path.filename().string());
  if (!text) {
    text.error().where = path;
    return pass_on(text);
  }
  return write_files({{image_path.string(), std::move(text->image)}, {path, std::move(text->yaml)}});
}

}  // namespace outrider
