#include "outrider/io/map/map.hpp"

#include <fmt/format.h>

#include <array>
#include <optional>

#include "map/image.hpp"
#include "outrider/io/files/files.hpp"
#include "outrider/io/files/text.hpp"
#include "outrider/io/map/movingai.hpp"
#include "outrider/path/visibility/polygons_from_world.hpp"

namespace outrider {
namespace {

constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
constexpr std::array<std::string_view, 7> map_server_keys = {
    "image", "resolution", "origin", "negate", "occupied_thresh", "free_thresh", "mode"};
constexpr std::size_t most_looked_at = 4096;  // bytes searched for the first line that is not a comment

/// Detects the kind of a map by a line that is not a comment.
std::optional<MapKind> kind_of_line(std::string_view line) {
  if (line.starts_with('<')) return MapKind::world;
  if (line.starts_with('(')) return MapKind::polygons;
  const auto parts = words(line);
  if (parts.size() == 2 && parts[0] == "type") return MapKind::movingai;
  const std::string_view key = line.substr(0, line.find_first_of(": \t"));
  const bool has_value = line.find(':') != std::string_view::npos;
  for (const std::string_view known : map_server_keys) {
    if (has_value && key == known) return MapKind::map_server;
  }
  return std::nullopt;
}

/// Detects the kind of a map by its first lines, without comments.
std::optional<MapKind> kind_of_content(std::string_view content) {
  if (is_image(content)) return MapKind::image;
  if (content.starts_with(byte_order_mark)) content.remove_prefix(byte_order_mark.size());
  for (TextLines lines{content.substr(0, most_looked_at), {}}; lines.next_filled();) {
    if (const auto kind = kind_of_line(trimmed(lines.line))) return kind;
  }
  return std::nullopt;
}

std::optional<MapKind> kind_of_name(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, MapKind>, 8> endings = {{{".yaml", MapKind::map_server},
                                                                            {".yml", MapKind::map_server},
                                                                            {".sdf", MapKind::world},
                                                                            {".world", MapKind::world},
                                                                            {".map", MapKind::movingai},
                                                                            {".txt", MapKind::polygons},
                                                                            {".png", MapKind::image},
                                                                            {".pgm", MapKind::image}}};
  for (const auto& [ending, kind] : endings) {
    if (without_gz(name).ends_with(ending)) return kind;
  }
  return std::nullopt;
}

/// Makes a map of the kind from what its reader returned.
template <class Shape>
Outcome<LoadedMap> map_of(MapKind kind, Outcome<Shape> shape, std::vector<std::string> warnings = {}) {
  if (!shape) return pass_on(shape);
  return LoadedMap{kind, std::move(*shape), std::move(warnings)};
}

Outcome<LoadedMap> read_map(MapKind kind, const std::string& content, const std::string& path,
                            const LoadMapOptions& options) {
  const double pixel_m = options.image_resolution_m;
  switch (kind) {
    case MapKind::map_server: return map_of(kind, map_server_from_text(content, path));
    case MapKind::image:
      return map_of(kind, map_image_from_bytes(content, path, pixel_m),
                    {fmt::format("an image alone has no scale: a pixel is taken as {:g} m", pixel_m)});
    case MapKind::movingai: {
      auto cells = movingai_map_from_text(content, path);
      if (!cells) return pass_on(cells);
      return LoadedMap{kind, MapCells{std::move(*cells), 0.0}};
    }
    case MapKind::polygons: return map_of(kind, polygon_map_from_text(content, path));
    case MapKind::world: break;
  }
  auto loaded = sdf_from_text(content, path, options.sdf);
  if (!loaded) return pass_on(loaded);
  return LoadedMap{kind, std::move(loaded->world), std::move(loaded->warnings)};
}

constexpr double any_radius_m = 0.2;  // the polygons of a world do not depend on it

}  // namespace

std::string_view to_string(MapKind kind) {
  constexpr std::array<std::string_view, 5> names = {"map_server", "image", "movingai", "polygons", "world"};
  return names.at(static_cast<std::size_t>(kind));
}

Outcome<MapKind> map_kind(std::string_view content, const std::string& path) {
  if (const auto kind = kind_of_content(content)) return *kind;
  if (const auto kind = kind_of_name(path)) return *kind;
  return bad_input(
      "the name does not tell what kind of map it is; maps end in .yaml, .yml, .sdf, .world, .map, .txt, "
      ".png or .pgm (.gz may follow)",
      path);
}

Outcome<PolygonMap> polygons_of(const World& world, double height_m) {
  auto polygons = polygons_from_world(CollisionMap::of(world, height_m), any_radius_m);
  if (!polygons) return pass_on(polygons);
  return PolygonMap{std::move(polygons->boundary), std::move(polygons->obstacles), {}};
}

Outcome<LoadedMap> load_map(const std::string& path, const LoadMapOptions& options) {
  auto content = read_file(path);
  if (!content) return pass_on(content);
  const auto kind = map_kind(*content, path);
  if (!kind) return bad_input(kind.error().sentence, kind.error().where);
  auto map = read_map(*kind, *content, path, options);
  if (!map) return map;
  const auto* cells = std::get_if<MapCells>(&map->shape);
  if (cells != nullptr && cells->occupancy.cells.size() > options.most_cells) {
    const GridFrame& frame = cells->occupancy.frame;
    return bad_input(fmt::format("a map of {} x {} cells is too large; at most {} cells are taken",
                                 frame.width, frame.height, options.most_cells),
                     path);
  }
  return map;
}

}  // namespace outrider
