#include "outrider/io/map_server.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <optional>

#include "image.hpp"
#include "outrider/io/files.hpp"
#include "outrider/io/text.hpp"
#include "yaml.hpp"

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
  std::string mode = "trinary";
};

/// Reads keys of one YAML file and keeps the first fault.
struct KeyReader {
  const YAML::Node& root;
  const std::string& name;
  Status status = {};

  void refuse(const YAML::Node& node, std::string_view key, std::string_view right) {
    if (!status) return;
    status = bad_input(node.IsDefined() ? fmt::format("'{}' is not valid; expected {}", key, right)
                                        : fmt::format("the key '{}' is missing; expected {}", key, right),
                       node.IsDefined() ? yaml_where(name, node) : name);
  }
  void read(double& value, std::string_view key, double low, double high, bool required,
            std::string_view right) {
    const YAML::Node node = root[std::string(key)];
    if (!node.IsDefined() && !required) return;
    const auto parsed = node.IsDefined() && node.IsScalar() ? number<double>(node.Scalar()) : std::nullopt;
    if (parsed && *parsed >= low && *parsed <= high) {
      value = *parsed;
    } else {
      refuse(node, key, right);
    }
  }
  void read(std::string& value, std::string_view key, bool required, std::string_view right) {
    const YAML::Node node = root[std::string(key)];
    if (!node.IsDefined() && !required) return;
    if (node.IsDefined() && node.IsScalar() && !node.Scalar().empty()) {
      value = node.Scalar();
    } else {
      refuse(node, key, right);
    }
  }
};

/// Reads x, y and, if given, yaw.
std::optional<std::array<double, 3>> origin_of(const YAML::Node& node) {
  if (!node.IsDefined() || !node.IsSequence() || node.size() < 2 || node.size() > 3) return std::nullopt;
  std::array<double, 3> origin{};
  for (std::size_t i = 0; i < node.size(); ++i) {
    const auto value = node[i].IsScalar() ? number<double>(node[i].Scalar()) : std::nullopt;
    if (!value || std::abs(*value) > farthest_origin_m) return std::nullopt;
    origin[i] = *value;
  }
  return origin;
}

Outcome<MapKeys> map_keys(std::string_view text, const std::string& name) {
  auto root = yaml_map(text, name);
  if (!root) return pass_on(root);
  const YAML::Node& map = root->IsMap() ? *root : YAML::Node(YAML::NodeType::Map);
  MapKeys keys;
  KeyReader reader{map, name};
  reader.read(keys.image, "image", true, "the name of a PGM or PNG file");
  reader.read(keys.resolution_m, "resolution", 1e-4, 1e3, true, "the side of a pixel in m, from 1e-4 to 1e3");
  if (const auto origin = origin_of(map["origin"])) {
    keys.origin = *origin;
  } else {
    reader.refuse(map["origin"], "origin", "[x, y, yaw], numbers from -1e6 to 1e6");
  }
  std::string negate = "0";
  reader.read(negate, "negate", false, "0 or 1");
  if (negate != "0" && negate != "1" && negate != "true" && negate != "false") {
    reader.refuse(map["negate"], "negate", "0 or 1");
  }
  keys.negate = negate == "1" || negate == "true";
  reader.read(keys.occupied_thresh, "occupied_thresh", 0.0, 1.0, false, "a number from 0 to 1");
  reader.read(keys.free_thresh, "free_thresh", 0.0, 1.0, false, "a number from 0 to 1");
  if (keys.free_thresh > keys.occupied_thresh) {
    reader.refuse(map["free_thresh"], "free_thresh", "a number at most occupied_thresh");
  }
  reader.read(keys.mode, "mode", false, "trinary, scale or raw");
  if (keys.mode != "trinary" && keys.mode != "scale" && keys.mode != "raw") {
    reader.refuse(map["mode"], "mode", "trinary, scale or raw");
  }
  if (!reader.status) return pass_on(reader.status);
  return keys;
}

Occupancy occupancy_of(std::uint8_t value, const MapKeys& keys) {
  const bool raw = keys.mode == "raw";
  if (raw && value > 100) return unknown_cell;
  const double shade = keys.negate ? value / 255.0 : (255 - value) / 255.0;
  const double p = raw ? value / 100.0 : shade;
  if (p > keys.occupied_thresh) return occupied_cell;
  return p < keys.free_thresh ? free_cell : unknown_cell;
}

/// Returns the grey value that map_server writes.
std::uint8_t shade_of(std::uint8_t occupancy) {
  if (occupancy == free_cell) return 254;
  return occupancy == occupied_cell ? 0 : 205;
}

Outcome<MapServerMap> map_from_bytes(std::string_view bytes, const std::string& path, const MapKeys& keys) {
  auto image = image_from_bytes(bytes, path);
  if (!image) return pass_on(image);

  MapServerMap map;
  map.yaw_rad = keys.origin[2];
  map.occupancy =
      Grid<std::uint8_t>({{keys.origin[0], keys.origin[1]}, keys.resolution_m, image->width, image->height});
  const GridFrame& frame = map.occupancy.frame;
  for (std::size_t pixel = 0; pixel < image->values.size(); ++pixel) {
    const Cell from_top = frame.cell(pixel);
    const bool hidden = !image->transparent.empty() && image->transparent[pixel];
    map.occupancy[{from_top.x, frame.height - 1 - from_top.y}] =
        hidden ? unknown_cell : occupancy_of(image->values[pixel], keys);
  }
  return map;
}

Outcome<MapServerMap> map_from_image(const std::string& path, const MapKeys& keys) {
  auto bytes = read_file(path);
  if (!bytes) return pass_on(bytes);
  return map_from_bytes(*bytes, path, keys);
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
  return map_from_image((fs::path(name).parent_path() / keys->image).string(), *keys);
}

Outcome<MapServerMap> load_map_image(const std::string& path, double resolution_m) {
  MapKeys keys;
  keys.resolution_m = resolution_m;
  return map_from_image(path, keys);
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
