// Ground: what a robot of a given height can bump into while it drives, and how far it is from it.
//
// Obstacles are the exact footprints of the parts of the solids between the floor and the robot's
// top: one drives under a table between its legs. A uniform grid over the bounds keeps every query
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
  /// The obstacles of a world for a robot of that height; what rises less than `step_m` above the
  /// floor is driven over. On terrain these heights count from the lowest and to above the highest ground
  /// under each solid, and ground steeper than `max_slope_rad` is an obstacle too (steep_ground.hpp).
  static CollisionMap of(const World& world, double robot_height_m, double step_m = 1e-3,
                         double max_slope_rad = pi / 2);

  [[nodiscard]] const Box2& bounds() const { return bounds_; }
  [[nodiscard]] const std::vector<RoundedPolygon>& obstacles() const { return obstacles_; }

  /// The length of a straight drive along the surface, m. No less than that of the segment.
  [[nodiscard]] double length(Segment s) const { return terrain_ ? terrain_->length(s) : distance(s.a, s.b); }
  [[nodiscard]] const HeightField* terrain() const { return terrain_.get(); }  ///< null where it is flat

  /// Distance from p to the nearest obstacle or to the edge of the bounds, m, negative inside an
  /// obstacle or outside the bounds; cut off at `most_m`, which bounds the work.
  [[nodiscard]] double clearance(Vec2 p, double most_m) const;
  /// True when a disk of that radius can be swept along the segment without touching anything
  /// (contact within 1e-9 m is allowed). Exact.
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
  std::vector<Box2> boxes_;       // of the obstacles, by index
  std::vector<TileRange> tiles_;  // of the obstacles, by index
  double tile_m_ = 1.0;
  int columns_ = 1;
  int rows_ = 1;
  std::vector<std::uint32_t> first_;  // tile -> first entry in items_, one more at the end
  std::vector<std::uint32_t> items_;  // obstacle indices, tile by tile
};

}  // namespace outrider
