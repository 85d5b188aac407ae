#include "map_file.hpp"

#include <fmt/format.h>

#include "outrider/io/map_server.hpp"
#include "outrider/io/movingai.hpp"
#include "outrider/io/sdf.hpp"
#include "outrider/path/grid/from_occupancy.hpp"

namespace outrider::cli {
namespace {

Outcome<MapFile> from_world_file(const std::string& path, double radius_m, double height_m,
                                 const GridOptions& grid) {
  auto loaded = load_sdf(path);
  if (!loaded) return pass_on(loaded);
  MapFile map;
  map.warnings = std::move(loaded->warnings);
  map.radius_m = radius_m;
  map.ground = Ground::of(loaded->world, height_m);
  auto blocked = blocked_for_disk(*map.ground, radius_m, grid);
  if (!blocked) return pass_on(blocked);
  map.blocked = std::move(*blocked);
  return map;
}

Outcome<MapFile> from_cells(Grid<std::uint8_t> occupied, double yaw_rad, double radius_m) {
  MapFile map;
  map.radius_m = radius_m;
  map.yaw_rad = yaw_rad;
  auto blocked = inflated(occupied, radius_m);
  if (!blocked) return pass_on(blocked);
  map.blocked = std::move(*blocked);
  map.occupied = std::move(occupied);
  return map;
}

}  // namespace

bool is_world(const std::string& path) {
  std::string stem = path;
  if (stem.ends_with(".gz")) stem.resize(stem.size() - 3);
  return stem.ends_with(".sdf") || stem.ends_with(".world");
}

Vec2 MapFile::to_grid(Vec2 world) const {
  if (yaw_rad == 0.0) return world;
  const Vec2 origin = blocked.frame.origin;
  return origin + unrotated(yaw_rad, world - origin);
}

Vec2 MapFile::to_world(Vec2 grid) const {
  if (yaw_rad == 0.0) return grid;
  const Vec2 origin = blocked.frame.origin;
  return origin + rotated(yaw_rad, grid - origin);
}

Outcome<MapFile> load_map(const std::string& path, std::optional<double> radius_m, const RobotModel& robot,
                          const GridOptions& grid) {
  std::string stem = path;
  if (stem.ends_with(".gz")) stem.resize(stem.size() - 3);
  if (is_world(path)) {
    return from_world_file(path, radius_m.value_or(robot.radius_m), robot.height_m, grid);
  }
  if (stem.ends_with(".yaml") || stem.ends_with(".yml")) {
    auto map = load_map_server(path);
    if (!map) return pass_on(map);
    return from_cells(std::move(map->occupancy), map->yaw_rad, radius_m.value_or(robot.radius_m));
  }
  if (stem.ends_with(".map")) {
    auto map = load_movingai_map(path);
    if (!map) return pass_on(map);
    return from_cells(std::move(*map), 0.0, radius_m.value_or(0.0));
  }
  return bad_input(
      "the name does not tell what kind of map it is; maps end in .yaml, .yml, .sdf, .world, .map or .txt "
      "(.gz may "
      "follow)",
      path);
}

}  // namespace outrider::cli
