#include "sdf_shapes.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <sdf/Box.hh>
#include <sdf/Capsule.hh>
#include <sdf/Cylinder.hh>
#include <sdf/Ellipsoid.hh>
#include <sdf/Mesh.hh>
#include <sdf/Plane.hh>
#include <sdf/Sphere.hh>
#include <utility>

#include "outrider/io/files.hpp"
#include "outrider/io/terrain.hpp"

namespace outrider {
namespace {

using Pieces = std::vector<SdfPiece>;

constexpr double largest_m = 1e6;
constexpr double smallest_scale = 1e-6;
constexpr std::size_t most_world_triangles = 2'000'000;

Vec3 vec(const ignition::math::Vector3d& v) { return {v.X(), v.Y(), v.Z()}; }

bool is_shape_size(double size_m) { return size_m > 0.0 && size_m <= largest_m; }

bool is_scale(double factor) { return std::abs(factor) >= smallest_scale && std::abs(factor) <= largest_m; }

/// Returns a rotation that maps +z to a direction.
Rotation upward(Vec3 normal) {
  const Vec3 z = (1.0 / norm(normal)) * normal;
  if (z.z >= 1.0) return {};
  const Vec3 helper = std::abs(z.z) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0};
  const Vec3 across = cross(helper, z);
  const Vec3 x = (1.0 / norm(across)) * across;
  return {{x, cross(z, x), z}};
}

/// Makes a mesh around an ellipsoid: that of a sphere, scaled, and enlarged so that no face cuts the
/// ellipsoid.
MeshShape ellipsoid(Vec3 radii) {
  constexpr int rings = 24;
  constexpr int sides = 48;
  const double grow = 1.0 / (std::cos(std::numbers::pi / (2 * rings)) * std::cos(std::numbers::pi / sides));
  const auto point = [&](int ring, int side) {
    const double polar = std::numbers::pi * ring / rings;
    const Vec2 around = direction(2.0 * std::numbers::pi * (side % sides) / sides);
    const double out = ring == 0 || ring == rings ? 0.0 : std::sin(polar);
    return Vec3{grow * radii.x * out * around.x, grow * radii.y * out * around.y,
                grow * radii.z * std::cos(polar)};
  };
  MeshShape mesh;
  for (int ring = 0; ring < rings; ++ring) {
    for (int side = 0; side < sides; ++side) {
      const Vec3 a = point(ring, side);
      const Vec3 b = point(ring + 1, side);
      const Vec3 c = point(ring + 1, side + 1);
      const Vec3 d = point(ring, side + 1);
      if (ring + 1 < rings) mesh.triangles.push_back({a, b, c});
      if (ring > 0) mesh.triangles.push_back({a, c, d});
    }
  }
  return mesh;
}

tl::unexpected<Fault> bad_size() {
  return bad_input("its size is not above 0 and at most 1e6 m; correct it");
}

Outcome<Pieces> round_pieces(double radius_m, double length_m, bool capped) {
  if (!is_shape_size(radius_m) || !is_shape_size(length_m)) return bad_size();
  Pieces pieces = {{CylinderShape{radius_m, 0.5 * length_m}}};
  if (!capped) return pieces;
  pieces.push_back({SphereShape{radius_m}, {{0, 0, 0.5 * length_m}, {}}, "_top"});
  pieces.push_back({SphereShape{radius_m}, {{0, 0, -0.5 * length_m}, {}}, "_bottom"});
  return pieces;
}

Outcome<MeshShape> mesh_shape(const sdf::Mesh& mesh, SdfMeshes& meshes) {
  const Vec3 scale = vec(mesh.Scale());
  if (!is_scale(scale.x) || !is_scale(scale.y) || !is_scale(scale.z)) {
    return bad_input("its mesh's scale is no number from 1e-6 to 1e6; correct it");
  }
  auto found = meshes.by_path.find(mesh.Uri());
  if (found == meshes.by_path.end()) {
    auto loaded = load_mesh(mesh.Uri());
    if (!loaded) return pass_on(loaded);
    found = meshes.by_path.emplace(mesh.Uri(), std::move(*loaded)).first;
  }
  meshes.placed += found->second.size();
  if (meshes.placed > most_world_triangles) {
    return bad_input(fmt::format("the world's meshes have more than {} triangles; use simpler ones",
                                 most_world_triangles));
  }
  MeshShape result{found->second};
  for (Triangle& triangle : result.triangles) {
    for (Vec3& p : triangle) p = {scale.x * p.x, scale.y * p.y, scale.z * p.z};
  }
  return result;
}

}  // namespace

Outcome<HeightField> sdf_terrain(const sdf::Heightmap& heightmap, const Pose3& world_T_collision) {
  const auto& axes = world_T_collision.rotation.axes;
  if (axes[0].x < 1.0 - 1e-9 || axes[2].z < 1.0 - 1e-9) {
    return bad_input("a heightmap that is turned is not modelled; take the rotation out of its <pose>");
  }
  auto bytes = read_file(heightmap.Uri());
  if (!bytes) return pass_on(bytes);
  return terrain_from_png(*bytes, heightmap.Uri(), world_T_collision.position + vec(heightmap.Position()),
                          vec(heightmap.Size()));
}

Outcome<std::vector<SdfPiece>> sdf_pieces(const sdf::Geometry& geometry, SdfMeshes& meshes) {
  switch (geometry.Type()) {
    case sdf::GeometryType::BOX: {
      const Vec3 size = vec(geometry.BoxShape()->Size());
      if (!is_shape_size(size.x) || !is_shape_size(size.y) || !is_shape_size(size.z)) return bad_size();
      return Pieces{{BoxShape{0.5 * size}}};
    }
    case sdf::GeometryType::CYLINDER:
      return round_pieces(geometry.CylinderShape()->Radius(), geometry.CylinderShape()->Length(), false);
    case sdf::GeometryType::CAPSULE:
      return round_pieces(geometry.CapsuleShape()->Radius(), geometry.CapsuleShape()->Length(), true);
    case sdf::GeometryType::SPHERE:
      if (!is_shape_size(geometry.SphereShape()->Radius())) return bad_size();
      return Pieces{{SphereShape{geometry.SphereShape()->Radius()}}};
    case sdf::GeometryType::ELLIPSOID: {
      const Vec3 radii = vec(geometry.EllipsoidShape()->Radii());
      if (!is_shape_size(radii.x) || !is_shape_size(radii.y) || !is_shape_size(radii.z)) return bad_size();
      return Pieces{{ellipsoid(radii)}};
    }
    case sdf::GeometryType::PLANE: {
      const Vec3 normal = vec(geometry.PlaneShape()->Normal());
      if (!is_scale(norm(normal))) return bad_input("its plane's normal is no direction; write e.g. 0 0 1");
      return Pieces{{HalfSpaceShape{}, {{}, upward(normal)}}};
    }
    case sdf::GeometryType::MESH: {
      auto mesh = mesh_shape(*geometry.MeshShape(), meshes);
      if (!mesh) return pass_on(mesh);
      return Pieces{{std::move(*mesh)}};
    }
    default: return Pieces{};
  }
}

}  // namespace outrider
