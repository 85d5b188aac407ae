#include "sdf/sdf_floor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "outrider/world/level_layers.hpp"

namespace outrider {
namespace {

constexpr double default_side_m = 20.0;
constexpr double least_side_m = 1.0;
constexpr double lowest_room_m = 0.5;  // nobody drives between two layers that are nearer to each other
constexpr double least_floor_m2 = 10.0;

bool bounded(const Solid& solid) {
  return !std::holds_alternative<HalfSpaceShape>(solid.shape) &&
         !std::holds_alternative<HeightFieldShape>(solid.shape);
}

/// Returns true for a box that lies flat and is at most as thick as a tenth of its shorter side.
bool is_slab(const Solid& solid) {
  const auto* box = std::get_if<BoxShape>(&solid.shape);
  return box != nullptr && solid.world_T_solid.rotation.axes[2].z > 1.0 - 1e-9 &&
         box->half_size.z <= 0.1 * std::min(box->half_size.x, box->half_size.y);
}

/// Returns the corners of the convex hull of all that stands, from above.
std::vector<Vec2> hull_of_all(const World& world) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  std::vector<Vec2> corners;
  for (const Solid& solid : world.solids) {
    if (!bounded(solid)) continue;
    for (const RoundedPolygon& piece : footprint(solid, -inf, inf)) {
      for (const Vec2 corner : piece.core) {
        for (const Vec2 aside : {Vec2{-1, -1}, Vec2{-1, 1}, Vec2{1, -1}, Vec2{1, 1}})
          corners.push_back(corner + piece.radius_m * aside);
      }
    }
  }
  return convex_hull(std::move(corners));
}

/// Returns the area of the smallest turned rectangle around all that stands, m2. One of its sides lies on a
/// side of the convex hull (Freeman and Shapira, Communications of the ACM 18 (1975) 409-413). O(n log n +
/// h^2).
double area_of_all(const World& world) {
  const std::vector<Vec2> hull = hull_of_all(world);
  double least_m2 = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const double turn_rad = heading_of(hull[(i + 1) % hull.size()] - hull[i]);
    Box2 box;
    for (const Vec2 corner : hull) box.include(rotated(-turn_rad, corner));
    least_m2 = std::min(least_m2, box.size().x * box.size().y);
  }
  return hull.empty() ? 0.0 : least_m2;
}

Box2 box_of_all(const World& world) {
  Box2 all;
  for (const Solid& solid : world.solids) {
    if (!bounded(solid)) continue;
    all.include(bounds(solid).ground().low);
    all.include(bounds(solid).ground().high);
  }
  return all;
}

/// Returns the highest slab that reaches under everything and has only such slabs below it.
std::optional<Box3> slab_floor(const World& world, const Box2& all) {
  const auto covers = [&](const Solid& solid) {  // others may extend over its edge by a tenth of its size
    const Box2 box = bounds(solid).ground();
    const Box2 grown = box.grown(0.1 * std::min(box.size().x, box.size().y));
    return is_slab(solid) && grown.contains(all.low) && grown.contains(all.high);
  };
  std::vector<Box3> slabs;
  double lowest_middle_m = std::numeric_limits<double>::infinity();  // of all solids that are not such slabs
  for (const Solid& solid : world.solids) {
    if (!bounded(solid)) continue;
    const Box3 box = bounds(solid);
    if (covers(solid)) {
      slabs.push_back(box);
    } else {
      lowest_middle_m = std::min(lowest_middle_m, 0.5 * (box.low.z + box.high.z));
    }
  }
  std::optional<Box3> floor;
  for (const Box3& slab : slabs) {
    const bool under = slab.high.z < lowest_middle_m;
    if (under && (!floor || slab.high.z > floor->high.z)) floor = slab;
  }
  return floor;
}

/// Returns the height of the floor that lies on a ground, such as asphalt, mats or the mesh of a street: what
/// covers three quarters of everything, with no room below it. If there is none, that of the ground.
double floor_on(double ground_m, const World& world, const Box2& all) {
  const double least_m2 = std::max(least_floor_m2, 0.75 * area_of_all(world));
  double floor_m = ground_m;
  for (const Layer& layer : level_layers(world, all, least_m2)) {
    if (layer.height_m > floor_m && layer.height_m <= floor_m + lowest_room_m) floor_m = layer.height_m;
  }
  return floor_m;
}

Box2 around(Vec2 centre, Vec2 size) {
  const double x = size.x >= least_side_m ? size.x : default_side_m;
  const double y = size.y >= least_side_m ? size.y : default_side_m;
  return {centre - 0.5 * Vec2{x, y}, centre + 0.5 * Vec2{x, y}};
}

}  // namespace

Status set_floor_and_bounds(World& world, const std::vector<FloorPlane>& planes, const std::string& name) {
  const Box2 all = box_of_all(world);
  Box2 floor_box = all;
  const auto highest =
      std::ranges::max_element(planes, {}, [](const FloorPlane& plane) { return plane.point.z; });
  if (world.terrain) {
    floor_box = world.terrain->bounds();
  } else if (highest != planes.end()) {
    world.floor_z_m = floor_on(highest->point.z, world, all);
    floor_box = around(xy(highest->point), highest->size);
  } else if (const auto slab = slab_floor(world, all)) {
    world.floor_z_m = floor_on(slab->high.z, world, all);
    floor_box = slab->ground();
  } else {
    const auto layers = level_layers(world, all, std::max(least_floor_m2, 0.5 * area_of_all(world)));
    if (layers.empty()) {
      return bad_input(
          "the world has no floor; add a model with a <plane> collision, or a box or a mesh that lies level "
          "under "
          "half of everything",
          name);
    }
    world.floor_z_m = floor_on(layers.front().height_m, world, all);
  }
  world.bounds = standing_bounds(world);
  if (world.bounds.empty()) world.bounds = floor_box;
  return {};
}

}  // namespace outrider
