// PlanGround: a map prepared for path planning.
#pragma once

#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

#include "outrider/io/map/cost_map.hpp"
#include "outrider/io/map/map.hpp"
#include "outrider/path/from_world.hpp"
#include "outrider/path/problem.hpp"
#include "outrider/world/collision_map.hpp"

namespace outrider {

/// The ground as a grid, as polygons, or as both: polygons with a grid for the planners that need one.
struct PlanGround {
  Grid<std::uint8_t> occupied;  ///< occupied cells of the map; empty if the map has exact shapes
  Grid<std::uint8_t> blocked;   ///< cells that the centre of the robot must not enter; empty without a grid
  std::optional<CollisionMap> shapes;  ///< exact obstacles of a world, if it is planned on as a grid
  double yaw_rad = 0.0;                ///< rotation of the grid about its origin, in the world frame
  double radius_m = 0.0;               ///< radius of the robot, or beyond its outline
  std::vector<Vec2> outline = {};      ///< corners of a robot that steers (Problem::outline)
  std::shared_ptr<const GridMap> grid = nullptr;            ///< null if there is no grid
  std::shared_ptr<const PolygonGround> polygons = nullptr;  ///< null if there are no polygons
  std::shared_ptr<const CellCosts> costs = nullptr;         ///< costs of the cells; null: all equal
  std::shared_ptr<const GridMap> standing =
      nullptr;  ///< the occupied cells; null if the map has exact shapes

  /// Convert a point between the world frame and the frame of the grid.
  [[nodiscard]] Vec2 to_grid(Vec2 world) const;
  [[nodiscard]] Vec2 to_world(Vec2 on_grid) const;
  [[nodiscard]] Box2 bounds() const;  ///< bounding box in the world frame
};

/// A change of cells after the map is read.
struct PlanCellChange {
  CellChange change;
  std::string where;  ///< the place that a fault names, such as a key
};

/// The sources of the costs of the ground.
struct PlanCostOptions {
  std::shared_ptr<const CostMap> map = nullptr;          ///< cost per metre; null: 1
  std::shared_ptr<const HeightField> terrain = nullptr;  ///< its slopes cost more; null: flat
  double per_slope = 0.0;  ///< cost per metre added for a slope of 45 degrees, in proportion to its tangent

  [[nodiscard]] bool any() const { return map != nullptr || (terrain != nullptr && per_slope > 0.0); }
};

/// Options of plan_ground().
struct PlanGroundOptions {
  double radius_m = 0.26;                    ///< radius of the robot, or beyond its outline
  double height_m = 0.2;                     ///< height of the robot; used for worlds
  GridModel model = GridModel::cells;        ///< model of the grid
  GridOptions grid;                          ///< options of a grid that is made from exact shapes
  bool as_polygons = false;                  ///< convert a world to polygons instead of a grid
  bool needs_grid = true;                    ///< make a grid for polygons too
  std::vector<PlanCellChange> changes = {};  ///< changes of blocked cells, applied in this order
  PlanCostOptions costs = {};                ///< costs of the ground
  std::stop_token stop = {};                 ///< cancels the preparation
  std::vector<Vec2> outline = {};            ///< corners of a robot that steers (Problem::outline)
};

/// Prepares a map. Faults: bad_input for numbers that make no ground, for changes outside the grid, for
/// changes of a map without cells, and for costs that do not fit the grid; cancelled. O(cells), plus the
/// complexity of making grids and polygons.
Outcome<PlanGround> plan_ground(const MapShape& map, const PlanGroundOptions& options);

}  // namespace outrider
