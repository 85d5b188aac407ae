#include "outrider/io/map/path_problem.hpp"

#include <fmt/format.h>

#include "outrider/core/units.hpp"
#include "outrider/io/map/map.hpp"
#include "outrider/path/from_world.hpp"
#include "outrider/path/grid/from_occupancy.hpp"

namespace outrider {
namespace {

constexpr double usual_radius_m = 0.26;

Outcome<GridMap> grid_of(const LoadedMap& map, const std::string& path, const MapOptions& options) {
  if (const auto* world = std::get_if<World>(&map.shape)) {
    return grid_from_world(CollisionMap::of(*world, options.height_m),
                           options.radius_m.value_or(usual_radius_m), options.model,
                           {.resolution_m = options.resolution_m});
  }
  const auto& cells = std::get<MapCells>(map.shape);
  if (cells.yaw_rad != 0.0) {
    return bad_input(fmt::format("the map is turned by {:.4g} degrees, so its grid has axes of its own; "
                                 "load it with load_map_server() and turn the points",
                                 degrees(cells.yaw_rad)),
                     path);
  }
  const double radius_m = map.kind == MapKind::movingai ? 0.0 : usual_radius_m;
  return grid_from_occupancy(cells.occupancy, options.radius_m.value_or(radius_m), options.model);
}

}  // namespace

Outcome<Problem> load_path_problem(const std::string& path, Vec2 start, Vec2 goal,
                                   const MapOptions& options) {
  auto map = load_map(path);
  if (!map) return pass_on(map);
  Problem problem{nullptr, start, goal};
  if (auto* shape = std::get_if<PolygonMap>(&map->shape)) {
    auto polygons = PolygonGround::of(std::move(shape->boundary), std::move(shape->obstacles),
                                      options.radius_m.value_or(0.18));
    if (!polygons) return pass_on(polygons);
    problem.polygons = std::make_shared<const PolygonGround>(std::move(*polygons));
    return problem;
  }
  auto grid = grid_of(*map, path, options);
  if (!grid) return pass_on(grid);
  problem.grid = std::make_shared<const GridMap>(std::move(*grid));
  return problem;
}

}  // namespace outrider
