#include <fmt/format.h>

#include <mutex>

#include "maps.hpp"
#include "outrider/io/files.hpp"
#include "outrider/io/map_server.hpp"
#include "outrider/io/movingai.hpp"
#include "outrider/io/sdf.hpp"
#include "outrider/path/polygons_from_world.hpp"
#include "temporary_folder.hpp"

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
  auto folder = TemporaryFolder::make();
  if (!folder) return pass_on(folder);
  const std::string yaml = (folder->path() / "map.yaml").string();
  std::string quoted;  // as YAML has it: a quote is doubled
  for (const char c : file.string()) quoted.append(c == '\'' ? 2 : 1, c);
  const std::string text = fmt::format(
      "image: '{}'\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\n"
      "free_thresh: 0.196\n",
      quoted);
  if (auto ok = write_file(yaml, text); !ok) return pass_on(ok);
  auto map = from_map_server(yaml);
  if (map) map->warnings.emplace_back("an image alone has no scale: a pixel is taken as 0.05 m");
  return map;
}

Outcome<KnownMap> from_movingai(const fs::path& file) {
  auto cells = load_movingai_map(file.string());
  if (!cells) return pass_on(cells);
  return KnownMap{{}, {}, CellMap{std::move(*cells), 0.0}, {}, 0.0};
}

Outcome<KnownMap> from_world(const fs::path& file) {
  const std::lock_guard lock(reading_worlds());
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

std::mutex& reading_worlds() {
  static std::mutex one_at_a_time;
  return one_at_a_time;
}

Outcome<PolygonMap> polygons_of(const World& world, double radius_m, double height_m) {
  auto polygons = polygons_from_world(Ground::of(world, height_m), radius_m);
  if (!polygons) return pass_on(polygons);
  return PolygonMap{polygons->boundary, polygons->obstacles, {}};
}

Outcome<KnownMap> load_known_map(const fs::path& file, const Folder& folder) {
  if (auto ok = folder.check_references(file); !ok) return pass_on(ok);
  auto map = checked(by_extension(file));
  if (!map) return tl::unexpected(without_folder(std::move(map.error()), folder.root()));
  map->name = file.filename().string();
  return map;
}

Outcome<KnownMap> read_dropped_map(const std::vector<std::pair<std::string, std::string>>& files) {
  auto home = TemporaryFolder::make();
  if (!home) return pass_on(home);
  auto folder = Folder::open(home->path().string());
  if (!folder) return pass_on(folder);
  fs::path map;
  for (const auto& [name, bytes] : files) {
    const auto place = folder->resolve(name);
    if (!place || place->parent_path() != folder->root()) return bad_input("it is no name of a file", name);
    if (auto ok = write_file(place->string(), bytes); !ok) return pass_on(ok);
    if (map.empty() || (is_image(map) && !is_image(*place))) map = *place;
  }
  if (map.empty()) return bad_input("no file was sent; drop one", "files");
  return load_known_map(map, *folder);
}

}  // namespace outrider::server
