#include "outrider/io/path_problem.hpp"

#include <fmt/format.h>

#include "outrider/core/units.hpp"
#include "outrider/io/map_server.hpp"
#include "outrider/io/movingai.hpp"
#include "outrider/io/polygons.hpp"
#include "outrider/io/sdf.hpp"
#include "outrider/path/from_world.hpp"
#include "outrider/path/grid/from_occupancy.hpp"

namespace outrider {
namespace {

constexpr double usual_radius_m = 0.26;

Outcome<GridGround> grid_of(const std::string& path, std::string_view stem, const MapOptions& options) {
  if (stem.ends_with(".map")) {
    auto map = load_movingai_map(path);
    if (!map) return pass_on(map);
    return grid_from_occupancy(*map, options.radius_m.value_or(0.0), options.model);
  }
  if (stem.ends_with(".yaml") || stem.ends_with(".yml")) {
    auto map = load_map_server(path);
    if (!map) return pass_on(map);
    if (map->yaw_rad != 0.0) {
      return bad_input(fmt::format("the map is turned by {:.4g} degrees, so its grid has axes of its own; "
                                   "load it with load_map_server() and turn the points",
                                   degrees(map->yaw_rad)),
                       path);
    }
    return grid_from_occupancy(map->occupancy, options.radius_m.value_or(usual_radius_m), options.model);
  }
  if (!stem.ends_with(".sdf") && !stem.ends_with(".world")) {
    return bad_input(
        "the name does not tell what kind of map it is; maps end in .map, .yaml, .yml, .sdf, .world or "
        ".txt (.gz may follow)",
        path);
  }
  auto loaded = load_sdf(path);
  if (!loaded) return pass_on(loaded);
  return grid_from_world(Ground::of(loaded->world, options.height_m),
                         options.radius_m.value_or(usual_radius_m), options.model,
                         {.resolution_m = options.resolution_m});
}

Outcome<PolygonGround> polygons_of(const std::string& path, const MapOptions& options) {
  auto map = load_polygon_map(path);
  if (!map) return pass_on(map);
  return PolygonGround::of(std::move(map->boundary), std::move(map->obstacles),
                           options.radius_m.value_or(0.18));
}

}  // namespace

Outcome<Problem> load_path_problem(const std::string& path, Vec2 start, Vec2 goal,
                                   const MapOptions& options) {
  std::string_view stem = path;
  if (stem.ends_with(".gz")) stem.remove_suffix(3);
  Problem problem{nullptr, start, goal};
  if (stem.ends_with(".txt")) {
    auto polygons = polygons_of(path, options);
    if (!polygons) return pass_on(polygons);
    problem.polygons = std::make_shared<const PolygonGround>(std::move(*polygons));
    return problem;
  }
  auto grid = grid_of(path, stem, options);
  if (!grid) return pass_on(grid);
  problem.grid = std::make_shared<const GridGround>(std::move(*grid));
  return problem;
}

}  // namespace outrider
