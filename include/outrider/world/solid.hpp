// Solids: the objects of a world that stop a robot or a ball.
//
// Distances are exact for every shape. Footprints are exact except for tilted cylinders. Slices are exact
// except for cylinders and spheres. A cylinder is replaced there by a prism around it, whose corners are at
// most 0.13 % of its radius outside; a sphere is replaced by a polygon of 48 corners on its outline.
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
struct CylinderShape {  ///< with its axis along z of the solid's frame
  double radius_m = 0.0;
  double half_length_m = 0.0;
};
struct SphereShape {
  double radius_m = 0.0;
};
/// The half-space z <= 0 of the solid's frame: the ground, or an infinite cliff.
struct HalfSpaceShape {};
/// A surface of triangles. A ball cannot pass a triangle. The space that the surface encloses is not solid.
struct MeshShape {
  std::vector<std::array<Vec3, 3>> triangles;
};

/// The ground under a height field. The field is given in the world frame, so the pose of the solid must be
/// the identity.
struct HeightFieldShape {
  std::shared_ptr<const HeightField> field;
};

using Shape = std::variant<BoxShape, CylinderShape, SphereShape, HalfSpaceShape, MeshShape, HeightFieldShape>;

struct Solid {
  std::string name;
  Pose3 world_T_solid;
  Shape shape;
};

/// Returns "box", "cylinder", "sphere", "half_space", "mesh" or "height_field".
std::string_view kind(const Shape& shape);

/// Returns the distance from p to the solid, m; 0 inside or on it. Exact. O(1); O(triangles) for meshes; for
/// height fields as HeightField::distance().
double distance(Vec3 p, const Solid& solid);

/// Returns the smallest box around the solid. The box of a half-space is infinite, except at the surface of a
/// horizontal one; the box of a height field is infinite downwards.
Box3 bounds(const Solid& solid);

/// Projects the part of the solid with z_low <= z <= z_high onto the ground, as convex pieces. There are none
/// if the solid has no such part, and none for a half-space or a height field.
std::vector<RoundedPolygon> footprint(const Solid& solid, double z_low_m, double z_high_m);

/// Returns the convex pieces in which the vertical plane through `origin` along the unit vector `along` cuts
/// the solid, in plane coordinates (distance along, height), for side views. A half-space is limited to
/// |distance| <= 1e3 m and to heights within 1e3 m of its position, a height field to 1e3 m below its lowest
/// point.
std::vector<std::vector<Vec2>> slice(const Solid& solid, Vec2 origin, Vec2 along);

}  // namespace outrider
