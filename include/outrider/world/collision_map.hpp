// CollisionMap: the obstacles for a robot of a given height, with collision and clearance queries.
//
// Obstacles are the exact footprints of the parts of the solids between the floor and the top of the robot,
// so the robot can drive under a table between its legs. A uniform grid over the bounds makes every query
// local. Thread rule: const queries may run concurrently.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "outrider/core/units.hpp"
#include "outrider/geometry/box.hpp"
#include "outrider/geometry/convex.hpp"
#include "outrider/world/world.hpp"

namespace outrider {

class CollisionMap {
 public:
  CollisionMap(const Box2& bounds, std::vector<RoundedPolygon> obstacles,
               std::shared_ptr<const HeightField> terrain = {});
  /// Makes the map of a world for a robot of that height. The robot drives over anything lower than `step_m`
  /// above the floor. On terrain, a solid is an obstacle if a part of it lies between `step_m` above the
  /// lowest ground under it and the robot's height above the highest ground under it; ground steeper than
  /// `max_slope_rad` is an obstacle too (steep_ground.hpp).
  static CollisionMap of(const World& world, double robot_height_m, double step_m = 1e-3,
                         double max_slope_rad = pi / 2);

  [[nodiscard]] const Box2& bounds() const { return bounds_; }
  [[nodiscard]] const std::vector<RoundedPolygon>& obstacles() const { return obstacles_; }

  /// Returns the length of a straight drive along the surface, m. It is at least the length of the segment.
  [[nodiscard]] double length(Segment s) const { return terrain_ ? terrain_->length(s) : distance(s.a, s.b); }
  [[nodiscard]] const HeightField* terrain() const { return terrain_.get(); }  ///< null if the ground is flat

  /// Returns the distance from p to the nearest obstacle or to the edge of the bounds, m. It is negative
  /// inside an obstacle or outside the bounds, and cut off at `most_m`, which limits the computing time.
  [[nodiscard]] double clearance(Vec2 p, double most_m) const;
  /// Returns true if a disk of that radius can be swept along the segment without touching anything. Exact;
  /// an overlap of up to 1e-9 m is allowed.
  [[nodiscard]] bool segment_free(Segment s, double radius_m) const;

 private:
  struct TileRange {
    int x0, x1, y0, y1;
  };

  [[nodiscard]] TileRange tiles_of(const Box2& box) const;
  [[nodiscard]] std::size_t tile_index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(x);
  }
  template <class Visit>
  bool any_along(Segment s, double reach_m, Visit visit) const;
  [[nodiscard]] double edge_distance(Vec2 p) const;

  Box2 bounds_;
  std::shared_ptr<const HeightField> terrain_;
  std::vector<RoundedPolygon> obstacles_;
  std::vector<Box2> boxes_;       // bounding box of each obstacle
  std::vector<TileRange> tiles_;  // tiles of each obstacle
  double tile_m_ = 1.0;
  int columns_ = 1;
  int rows_ = 1;
  std::vector<std::uint32_t> first_;  // tile -> first entry in items_, one more at the end
  std::vector<std::uint32_t> items_;  // obstacle indices, tile by tile
};

}  // namespace outrider
