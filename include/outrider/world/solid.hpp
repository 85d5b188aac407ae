// Solids: the things of a world that stop a robot or a ball.
//
// Every shape is exact for distances. Footprints and slices are exact for upright boxes, upright
// cylinders, spheres, meshes and boxes in any rotation; a tilted cylinder is replaced there by a
// prism around it whose corners stand at most 0.13 % of its radius outside.
#pragma once

#include <array>
#include <memory>
#include <string>
#include <variant>
#include <vector>

#include "outrider/geometry/box.hpp"
#include "outrider/geometry/convex.hpp"
#include "outrider/geometry/pose.hpp"
#include "outrider/world/height_field.hpp"

namespace outrider {

struct BoxShape {
  Vec3 half_size;  ///< m
};
struct CylinderShape {  ///< axis along z of the solid's frame
  double radius_m = 0.0;
  double half_length_m = 0.0;
};
struct SphereShape {
  double radius_m = 0.0;
};
/// The half-space z <= 0 of the solid's frame: the ground, or a cliff without end.
struct HalfSpaceShape {};
/// A surface of triangles. A ball cannot pass a triangle; what the surface encloses is not filled.
struct MeshShape {
  std::vector<std::array<Vec3, 3>> triangles;
};

/// The ground under a height field, which is given in the world: the solid's pose is the identity.
struct HeightFieldShape {
  std::shared_ptr<const HeightField> field;
};

using Shape = std::variant<BoxShape, CylinderShape, SphereShape, HalfSpaceShape, MeshShape, HeightFieldShape>;

struct Solid {
  std::string name;
  Pose3 world_T_solid;
  Shape shape;
};

/// "box", "cylinder", "sphere", "half_space", "mesh" or "height_field".
std::string_view kind(const Shape& shape);

/// Distance from p to the solid, m; 0 inside it or on it. Exact. O(1), meshes O(triangles),
/// height fields as HeightField::distance().
double distance(Vec3 p, const Solid& solid);

/// Smallest box around the solid; infinite for a half-space, and downwards for a height field.
Box3 bounds(const Solid& solid);

/// The convex pieces that the part of the solid with z_low <= z <= z_high covers on the ground;
/// none when the solid has no part there, and none for a half-space or a height field.
std::vector<RoundedPolygon> footprint(const Solid& solid, double z_low_m, double z_high_m);

/// The convex pieces in which the vertical plane through `origin` along the unit vector `along` cuts
/// the solid, in plane coordinates (distance along, height): what a side view draws. Curved outlines
/// are polygons of 48 corners. A half-space is cut to |distance| <= 1e3 and a depth of 1e3, a
/// height field to the same depth.
std::vector<std::vector<Vec2>> slice(const Solid& solid, Vec2 origin, Vec2 along);

}  // namespace outrider
