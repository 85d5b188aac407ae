#include "outrider/jobs/plan/ground.hpp"

#include "ground_costs.hpp"
#include "outrider/path/from_polygons.hpp"
#include "outrider/path/grid/from_occupancy.hpp"
#include "outrider/path/visibility/polygons_from_world.hpp"

namespace outrider {
namespace {

/// All changes at once; where one is refused, the first that is.
Status change_cells(GridMap& grid, const std::vector<PlanCellChange>& changes) {
  std::vector<CellChange> all;
  for (const PlanCellChange& each : changes) all.push_back(each.change);
  if (auto changed = grid.with(all)) {
    grid = std::move(*changed);
    return {};
  }
  for (const PlanCellChange& each : changes) {
    auto changed = grid.with({each.change});
    if (!changed) return bad_input(changed.error().sentence, each.where);
  }
  return bad_input("the cells cannot be changed");
}

Status set_grid(PlanGround& ground, Outcome<Grid<std::uint8_t>> blocked, const PlanGroundOptions& options) {
  if (!blocked) return pass_on(blocked);
  auto grid = grid_map_of(*blocked, options.model, options.stop);
  if (!grid) return pass_on(grid);
  if (!options.changes.empty()) {
    if (auto ok = change_cells(*grid, options.changes); !ok) return ok;
    for (std::size_t i = 0; i < blocked->cells.size(); ++i) {
      blocked->cells[i] = grid->blocked(blocked->frame.cell(i)) ? 1 : 0;
    }
  }
  ground.blocked = std::move(*blocked);
  ground.grid = std::make_shared<const GridMap>(std::move(*grid));
  return {};
}

Status set_polygons(PlanGround& ground, Outcome<PolygonGround> polygons, const PlanGroundOptions& options) {
  if (!polygons) return pass_on(polygons);
  ground.polygons = std::make_shared<const PolygonGround>(std::move(*polygons));
  if (!options.needs_grid) return {};
  return set_grid(ground, blocked_for_disk(*ground.polygons, options.grid, options.stop), options);
}

Status set_shape(PlanGround& ground, const MapShape& map, const PlanGroundOptions& options) {
  if (const auto* cells = std::get_if<MapCells>(&map)) {
    ground.yaw_rad = cells->yaw_rad;
    ground.occupied = cells->occupancy;
    auto standing = grid_map_of(cells->occupancy, options.model, options.stop);
    if (!standing) return pass_on(standing);
    ground.standing = std::make_shared<const GridMap>(std::move(*standing));
    return set_grid(ground, inflated(cells->occupancy, options.radius_m, options.stop), options);
  }
  if (!options.changes.empty()) {
    return bad_input("it changes cells, and this map has exact shapes; leave it out, or take a map of cells",
                     options.changes.front().where);
  }
  if (const auto* polygons = std::get_if<PolygonMap>(&map)) {
    return set_polygons(ground, PolygonGround::of(polygons->boundary, polygons->obstacles, options.radius_m),
                        options);
  }
  CollisionMap shapes = CollisionMap::of(std::get<World>(map), options.height_m);
  if (options.as_polygons) {
    return set_polygons(ground, polygons_from_world(shapes, options.radius_m), options);
  }
  ground.shapes = std::move(shapes);
  return set_grid(ground, blocked_for_disk(*ground.shapes, options.radius_m, options.grid, options.stop),
                  options);
}

}  // namespace

Vec2 PlanGround::to_grid(Vec2 world) const {
  if (yaw_rad == 0.0) return world;
  const Vec2 origin = blocked.frame.origin;
  return origin + unrotated(yaw_rad, world - origin);
}

Vec2 PlanGround::to_world(Vec2 on_grid) const {
  if (yaw_rad == 0.0) return on_grid;
  const Vec2 origin = blocked.frame.origin;
  return origin + rotated(yaw_rad, on_grid - origin);
}

Box2 PlanGround::bounds() const {
  if (polygons) return polygons->bounds;
  const Box2 box = blocked.frame.bounds();
  Box2 turned;
  for (const Vec2 corner : {box.low, box.high, Vec2{box.low.x, box.high.y}, Vec2{box.high.x, box.low.y}}) {
    turned.include(to_world(corner));
  }
  return turned;
}

Outcome<PlanGround> plan_ground(const MapShape& map, const PlanGroundOptions& options) {
  PlanGround ground;
  ground.radius_m = options.radius_m;
  ground.outline = options.outline;
  if (auto ok = set_shape(ground, map, options); !ok) return pass_on(ok);
  if (!ground.grid) return ground;
  auto costs = ground_costs(options.costs, ground.grid->frame, ground.yaw_rad);
  if (!costs) return pass_on(costs);
  ground.costs = std::move(*costs);
  return ground;
}

}  // namespace outrider
