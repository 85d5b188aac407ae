#include "sdf_floor.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace outrider {
namespace {

constexpr double default_side_m = 20.0;
constexpr double least_side_m = 1.0;

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

/// Returns the highest slab that reaches under everything and has only such slabs below it.
std::optional<Box3> slab_floor(const World& world) {
  Box2 all;
  for (const Solid& solid : world.solids) {
    if (!bounded(solid)) continue;
    all.include(bounds(solid).ground().low);
    all.include(bounds(solid).ground().high);
  }
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

Box2 around(Vec2 centre, Vec2 size) {
  const double x = size.x >= least_side_m ? size.x : default_side_m;
  const double y = size.y >= least_side_m ? size.y : default_side_m;
  return {centre - 0.5 * Vec2{x, y}, centre + 0.5 * Vec2{x, y}};
}

}  // namespace

Status set_floor_and_bounds(World& world, const std::vector<FloorPlane>& planes, const std::string& name) {
  Box2 floor_box;
  const auto highest =
      std::ranges::max_element(planes, {}, [](const FloorPlane& plane) { return plane.point.z; });
  if (world.terrain) {
    floor_box = world.terrain->bounds();
  } else if (highest != planes.end()) {
    world.floor_z_m = highest->point.z;
    floor_box = around(xy(highest->point), highest->size);
  } else if (const auto slab = slab_floor(world)) {
    world.floor_z_m = slab->high.z;
    floor_box = slab->ground();
  } else {
    return bad_input(
        "the world has no floor; add a model with a <plane> collision, or a flat box under everything", name);
  }
  world.bounds = standing_bounds(world);
  if (world.bounds.empty()) world.bounds = floor_box;
  return {};
}

}  // namespace outrider
