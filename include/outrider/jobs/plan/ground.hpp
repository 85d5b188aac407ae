// A map made ready for a disk robot: the ground that path planners are asked on.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "outrider/io/map.hpp"
#include "outrider/path/from_world.hpp"
#include "outrider/path/problem.hpp"
#include "outrider/world/collision_map.hpp"

namespace outrider {

/// A grid, polygons, or both: polygons with a grid for the planners that need one.
struct PlanGround {
  Grid<std::uint8_t> occupied;         ///< cells that hold something; empty where the map has exact shapes
  Grid<std::uint8_t> blocked;          ///< cells where the robot's centre must not be; empty without a grid
  std::optional<CollisionMap> shapes;  ///< of a world, where it is planned on as a grid
  double yaw_rad = 0.0;                ///< of the grid about its origin, in the world
  double radius_m = 0.0;               ///< of the robot
  std::shared_ptr<const GridMap> grid = nullptr;
  std::shared_ptr<const PolygonGround> polygons = nullptr;

  [[nodiscard]] Vec2 to_grid(Vec2 world) const;
  [[nodiscard]] Vec2 to_world(Vec2 on_grid) const;
  [[nodiscard]] Box2 bounds() const;  ///< in the world
};

/// Cells to change once the map is read; `where` is what a fault names.
struct PlanCellChange {
  CellChange change;
  std::string where;
};

struct PlanGroundOptions {
  double radius_m = 0.26;  ///< of the robot
  double height_m = 0.2;   ///< of the robot, in a world
  GridModel model = GridModel::cells;
  GridOptions grid;                          ///< of one that is made of exact shapes
  bool as_polygons = false;                  ///< a world becomes polygons, not a grid
  bool needs_grid = true;                    ///< polygons get a grid too
  std::vector<PlanCellChange> changes = {};  ///< of the cells where the centre must not be, in this order
};

/// Faults: bad_input on numbers that make no ground; changes that leave the grid, or of a map without cells.
/// O(cells) and what the makers of grids and polygons say.
Outcome<PlanGround> plan_ground(const MapShape& map, const PlanGroundOptions& options);

}  // namespace outrider
