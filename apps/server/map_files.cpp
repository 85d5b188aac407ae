#include <fmt/format.h>

#include "maps.hpp"
#include "outrider/io/map_server.hpp"
#include "outrider/io/movingai.hpp"
#include "outrider/io/sdf.hpp"
#include "outrider/path/visibility/polygons_from_world.hpp"

namespace outrider::server {
namespace {

namespace fs = std::filesystem;

constexpr double robot_height_m = 0.2;
constexpr double usual_radius_m = 0.18;

/// The name without .gz, and what it ends with.
std::string extension_of(const fs::path& file) {
  fs::path plain = file;
  if (plain.extension() == ".gz") plain.replace_extension();
  return plain.extension().string();
}

bool is_image(const fs::path& file) {
  const std::string extension = extension_of(file);
  return extension == ".png" || extension == ".pgm";
}

Outcome<KnownMap> checked(Outcome<KnownMap> map) {
  if (!map) return map;
  const auto* cells = std::get_if<CellMap>(&map->shape);
  if (cells != nullptr && cells->occupancy.cells.size() > most_map_cells) {
    return bad_input(fmt::format("a map of {} x {} cells is too large for the page, which takes 4 million",
                                 cells->occupancy.frame.width, cells->occupancy.frame.height),
                     map->name);
  }
  return map;
}

Outcome<KnownMap> from_map_server(const fs::path& file) {
  auto map = load_map_server(file.string());
  if (!map) return pass_on(map);
  return KnownMap{{}, {}, CellMap{std::move(map->occupancy), map->yaw_rad}, {}};
}

/// An image alone, with the thresholds that map_server has as a rule.
Outcome<KnownMap> from_image(const fs::path& file) {
  auto map = load_map_image(file.string(), 0.05);
  if (!map) return pass_on(map);
  return KnownMap{{},
                  {},
                  CellMap{std::move(map->occupancy), map->yaw_rad},
                  {"an image alone has no scale: a pixel is taken as 0.05 m"}};
}

Outcome<KnownMap> from_movingai(const fs::path& file) {
  auto cells = load_movingai_map(file.string());
  if (!cells) return pass_on(cells);
  return KnownMap{{}, {}, CellMap{std::move(*cells), 0.0}, {}, 0.0};
}

Outcome<KnownMap> from_world(const fs::path& file) {
  auto loaded = load_sdf(file.string());
  if (!loaded) return pass_on(loaded);
  auto polygons = polygons_of(loaded->world, usual_radius_m, robot_height_m);
  if (!polygons) return pass_on(polygons);
  return KnownMap{{}, {}, std::move(*polygons), std::move(loaded->warnings)};
}

Outcome<KnownMap> by_extension(const fs::path& file) {
  const std::string extension = extension_of(file);
  if (extension == ".yaml" || extension == ".yml") return from_map_server(file);
  if (extension == ".sdf" || extension == ".world") return from_world(file);
  if (extension == ".map") return from_movingai(file);
  if (is_image(file)) return from_image(file);
  if (extension == ".txt") {
    auto map = load_polygon_map(file.string());
    if (!map) return pass_on(map);
    return KnownMap{{}, {}, std::move(*map), {}};
  }
  return bad_input(
      "the name does not tell what kind of map it is; maps end in .yaml, .yml, .sdf, .world, .map, .txt, "
      ".png "
      "or .pgm (.gz may follow)",
      file.filename().string());
}

}  // namespace

Outcome<PolygonMap> polygons_of(const World& world, double radius_m, double height_m) {
  auto polygons = polygons_from_world(Ground::of(world, height_m), radius_m);
  if (!polygons) return pass_on(polygons);
  return PolygonMap{polygons->boundary, polygons->obstacles, {}};
}

Outcome<KnownMap> load_known_map(const std::string& path, const Folder& folder) {
  const auto place = folder.resolve(path);
  if (!place) return bad_input("it lies outside the folder that is served", path);
  auto map = checked(by_extension(*place));
  if (!map) return tl::unexpected(without_folder(std::move(map.error()), folder.root()));
  map->name = place->filename().string();
  for (std::string& warning : map->warnings) warning = without_folder(std::move(warning), folder.root());
  return map;
}

}  // namespace outrider::server
