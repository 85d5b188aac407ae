#include "sdf/sdf_shapes.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "outrider/io/files/files.hpp"
#include "outrider/io/files/text.hpp"
#include "outrider/io/map/terrain.hpp"

namespace outrider {
namespace {

using Pieces = std::vector<SdfPiece>;

/// The kinds of shapes, those that are preferred first. An <empty> one is nothing.
constexpr auto sdf_shapes = {"box",  "capsule", "cylinder",  "ellipsoid", "plane", "sphere",
                             "mesh", "cone",    "heightmap", "polyline",  "empty"};

constexpr double largest_m = 1e6;
constexpr double smallest_scale = 1e-6;
constexpr std::size_t most_world_triangles = 2'000'000;
constexpr int rings = 24;  // of meshes of round shapes
constexpr int sides = 48;

bool is_shape_size(double size_m) { return size_m > 0.0 && size_m <= largest_m; }

bool is_scale(double factor) { return std::abs(factor) >= smallest_scale && std::abs(factor) <= largest_m; }

bool is_solid_size(Vec3 size_m) {
  return is_shape_size(size_m.x) && is_shape_size(size_m.y) && is_shape_size(size_m.z);
}

/// Returns a rotation that maps +z to a direction.
Rotation upward(Vec3 normal) {
  const Vec3 z = (1.0 / norm(normal)) * normal;
  if (z.z >= 1.0) return {};
  const Vec3 helper = std::abs(z.z) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0};
  const Vec3 across = cross(helper, z);
  const Vec3 x = (1.0 / norm(across)) * across;
  return {{x, cross(z, x), z}};
}

/// Makes the mesh of a profile that is turned about the z axis. Its points are distances from the axis, which
/// `x` and `y` scale, and heights, from the top down.
MeshShape turned(const std::vector<Vec2>& profile, double x, double y) {
  const auto point = [&](Vec2 at, int side) {
    const Vec2 around = direction(2.0 * std::numbers::pi * (side % sides) / sides);
    return Vec3{x * at.x * around.x, y * at.x * around.y, at.y};
  };
  MeshShape mesh;
  for (std::size_t i = 0; i + 1 < profile.size(); ++i) {
    const Vec2 above = profile[i], below = profile[i + 1];
    for (int side = 0; side < sides; ++side) {
      const Vec3 a = point(above, side), c = point(below, side + 1);
      if (below.x > 0.0) mesh.triangles.push_back({a, point(below, side), c});
      if (above.x > 0.0) mesh.triangles.push_back({a, c, point(above, side + 1)});
    }
  }
  return mesh;
}

/// Makes a mesh around an ellipsoid: that of a sphere, scaled, and enlarged so that no face cuts the
/// ellipsoid.
MeshShape ellipsoid(Vec3 radii) {
  const double grow = 1.0 / (std::cos(std::numbers::pi / (2 * rings)) * std::cos(std::numbers::pi / sides));
  std::vector<Vec2> profile = {{0.0, grow * radii.z}};
  for (int ring = 1; ring < rings; ++ring) {
    const double polar = std::numbers::pi * ring / rings;
    profile.push_back({grow * std::sin(polar), grow * radii.z * std::cos(polar)});
  }
  profile.push_back({0.0, -grow * radii.z});
  return turned(profile, radii.x, radii.y);
}

/// Makes a mesh around a cone whose tip is up: its sides touch the cone.
MeshShape cone(double radius_m, double length_m) {
  const double out_m = radius_m / std::cos(std::numbers::pi / sides);
  return turned({{0.0, 0.5 * length_m}, {out_m, -0.5 * length_m}, {0.0, -0.5 * length_m}}, 1.0, 1.0);
}

Pieces round_pieces(std::string_view kind, double radius_m, double length_m) {
  Pieces pieces = {{CylinderShape{radius_m, 0.5 * length_m}}};
  if (kind == "cylinder") return pieces;
  pieces.push_back({SphereShape{radius_m}, {{0, 0, 0.5 * length_m}, {}}, "_top"});
  pieces.push_back({SphereShape{radius_m}, {{0, 0, -0.5 * length_m}, {}}, "_bottom"});
  return pieces;
}

Status count_triangles(SdfMeshes& meshes, std::size_t triangles) {
  meshes.placed += triangles;
  if (meshes.placed <= most_world_triangles) return {};
  return bad_input(
      fmt::format("the world's meshes have more than {} triangles; use simpler ones", most_world_triangles));
}

// ---- Meshes --------------------------------------------------------------------------------------

void move_middle_to_origin(std::vector<Triangle>& triangles) {
  Box3 box;
  for (const Triangle& triangle : triangles) {
    for (const Vec3 p : triangle) box.include(p);
  }
  for (Triangle& triangle : triangles) {
    for (Vec3& p : triangle) p = p - 0.5 * (box.low + box.high);
  }
}

/// Loads a mesh, or the part of it that is asked for.
Outcome<const std::vector<Triangle>*> triangles_of(SdfFiles& files, const SdfFile& file, XmlElement mesh,
                                                   const std::string& path, SdfMeshes& meshes) {
  const XmlElement submesh = mesh.child("submesh");
  const std::string part(xml_text(submesh, "name"));
  const bool centre = one_of(xml_text(submesh, "center"), {"1", "true"});
  const auto [found, fresh] = meshes.by_part.try_emplace(fmt::format("{}\n{}\n{}", path, part, centre));
  if (!fresh) return &found->second;
  auto loaded = load_mesh(path, part);
  if (!loaded && !part.empty()) {
    loaded = load_mesh(path);
    if (loaded) {
      files.warnings.add(file.document.where(submesh),
                         fmt::format("the mesh '{}' has no part '{}'; the whole mesh was taken",
                                     excerpt(path, 200), excerpt(part)));
    }
  }
  if (!loaded) return pass_on(loaded);
  found->second = std::move(*loaded);
  if (centre) move_middle_to_origin(found->second);
  return &found->second;
}

Outcome<MeshShape> mesh_shape(SdfFiles& files, const SdfFile& file, XmlElement mesh, const std::string& path,
                              Vec3 scale, SdfMeshes& meshes) {
  if (!is_scale(scale.x) || !is_scale(scale.y) || !is_scale(scale.z))
    return bad_input("its mesh's scale is no number from 1e-6 to 1e6; correct it");
  auto triangles = triangles_of(files, file, mesh, path, meshes);
  if (!triangles) return pass_on(triangles);
  if (auto counted = count_triangles(meshes, (*triangles)->size()); !counted) return pass_on(counted);
  MeshShape result{**triangles};
  for (Triangle& triangle : result.triangles) {
    for (Vec3& p : triangle) p = {scale.x * p.x, scale.y * p.y, scale.z * p.z};
  }
  return result;
}

// ---- Polylines -----------------------------------------------------------------------------------

/// Adds a quadrilateral; its corners go around.
void add_quadrilateral(MeshShape& mesh, Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
  mesh.triangles.push_back({a, b, c});
  mesh.triangles.push_back({a, c, d});
}

using PolylineEdge = std::pair<Vec2, Vec2>;  // from the lower to the higher end

double x_at(const PolylineEdge& edge, double y) {
  const auto& [low, high] = edge;
  return low.x + (high.x - low.x) * ((y - low.y) / (high.y - low.y));
}

/// Covers what the edges enclose by the even-odd rule, at two heights: in strips between the heights of the
/// corners, it consists of trapezoids between neighbouring edges. O(edges^2 log edges).
void add_covers(MeshShape& mesh, const std::vector<PolylineEdge>& edges, double top_m) {
  std::set<double> levels;
  for (const auto& [low, high] : edges) levels.insert({low.y, high.y});
  for (auto level = levels.begin(); level != levels.end() && std::next(level) != levels.end(); ++level) {
    const double low = *level;
    const double high = *std::next(level);
    std::vector<PolylineEdge> crossing;
    for (const PolylineEdge& edge : edges) {
      if (edge.first.y <= low && edge.second.y >= high) crossing.push_back(edge);
    }
    std::ranges::sort(crossing, {}, [&](const PolylineEdge& edge) { return x_at(edge, 0.5 * (low + high)); });
    for (std::size_t k = 0; k + 1 < crossing.size(); k += 2) {
      for (const double z : {0.0, top_m}) {
        add_quadrilateral(mesh, {x_at(crossing[k], low), low, z}, {x_at(crossing[k + 1], low), low, z},
                          {x_at(crossing[k + 1], high), high, z}, {x_at(crossing[k], high), high, z});
      }
    }
  }
}

/// Makes the mesh around what the polylines of a geometry enclose, from z = 0 to their height.
Outcome<MeshShape> extruded(SdfNumbers& numbers, XmlElement first, double top_m) {
  constexpr std::size_t most_corners = 1000;
  MeshShape mesh;
  std::vector<PolylineEdge> edges;
  for (XmlElement line = first; line; line = line.next_sibling("polyline")) {
    std::vector<Vec2> corners;
    for (const XmlElement point : line.children("point")) {
      corners.push_back(xy(numbers.of(point, 2)));
      if (edges.size() + corners.size() > most_corners)
        return bad_input(fmt::format("its polylines have more than {} points; use a mesh", most_corners));
    }
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec2 a = corners[i];
      const Vec2 b = corners[(i + 1) % corners.size()];
      if (a != b)
        add_quadrilateral(mesh, {a.x, a.y, 0.0}, {b.x, b.y, 0.0}, {b.x, b.y, top_m}, {a.x, a.y, top_m});
      if (a.y != b.y) edges.emplace_back(a.y < b.y ? a : b, a.y < b.y ? b : a);
    }
  }
  add_covers(mesh, edges, top_m);
  return edges.empty() ? MeshShape{} : mesh;
}

}  // namespace

XmlElement sdf_shape(SdfFiles& files, const SdfFile& file, XmlElement collision, const std::string& name) {
  const XmlElement geometry = collision.child("geometry");
  const auto warn = [&](XmlElement at, const std::string& sentence) {
    files.warnings.add(file.document.where(at), sentence);
  };
  std::set<std::string_view> kinds;
  XmlElement first;
  XmlElement kept;
  for (const XmlElement child : geometry.children()) {
    if (child.type() != pugi::node_element) continue;
    if (!first) first = child;
    kinds.insert(child.name());
  }
  for (const char* kind : sdf_shapes) {
    if (!kept) kept = geometry.child(kind);
  }
  if (!first) {
    warn(collision, fmt::format("collision '{}' has no shape and was left out", name));
  } else if (!kept) {
    warn(collision, fmt::format("collision '{}' is a <{}>, which is not modelled; it was left out", name,
                                excerpt(first.name())));
  } else if (one_of(kept.name(), {"empty"})) {
    return {};
  } else if (kinds.size() > 1 || (kept.next_sibling(kept.name()) && !one_of(kept.name(), {"polyline"}))) {
    warn(geometry, fmt::format("a <geometry> has several shapes; its <{}> was kept", kept.name()));
  }
  return kept;
}

Vec3 SdfNumbers::of(XmlElement element, std::size_t count) {
  return read(element, element.name(), xml_text(element), count);
}

Vec3 SdfNumbers::of(XmlElement shape, const char* part, std::size_t count, Vec3 otherwise) {
  if (const XmlElement child = shape.child(part)) return of(child, count);
  const auto attribute = shape.attribute(part);  // in URDF
  return attribute ? read(shape, part, attribute.value(), count) : otherwise;
}

Vec3 SdfNumbers::read(XmlElement element, const char* name, std::string_view text, std::size_t count) {
  auto values = numbers_of(words(text, 4));
  const bool valid = values && values->size() == count;
  if (!valid && !fault_) {
    const std::string wanted = count == 1 ? "a finite number" : fmt::format("{} finite numbers", count);
    fault_ = Fault{FaultCode::bad_input, fmt::format("'{}' in a <{}> is not {}", excerpt(text), name, wanted),
                   file_.document.where(element)};
  }
  if (!valid) return {};
  values->resize(3);
  return {(*values)[0], (*values)[1], (*values)[2]};
}

Outcome<HeightField> sdf_terrain(const SdfFile& file, XmlElement heightmap, const std::string& path,
                                 const Pose3& world_T_collision) {
  const auto& axes = world_T_collision.rotation.axes;
  if (axes[0].x < 1.0 - 1e-9 || axes[2].z < 1.0 - 1e-9) {
    return bad_input("a heightmap that is turned is not modelled; take the rotation out of its <pose>");
  }
  SdfNumbers numbers(file);
  const Vec3 size = numbers.of(heightmap, "size", 3, {1, 1, 1});
  const Vec3 position = numbers.of(heightmap, "pos", 3, {});
  if (numbers.fault()) return tl::unexpected(*numbers.fault());
  auto bytes = read_file(path);
  if (!bytes) return pass_on(bytes);
  return terrain_from_png(*bytes, path, world_T_collision.position + position, size);
}

Outcome<Pieces> sdf_pieces(SdfFiles& files, const SdfFile& file, XmlElement shape, const std::string& mesh,
                           SdfMeshes& meshes) {
  const std::string_view kind = shape.name();
  SdfNumbers numbers(file);
  const Vec3 size =
      numbers.of(shape, kind == "ellipsoid" ? "radii" : "size", kind == "plane" ? 2 : 3, {1, 1, 1});
  const double radius_m = numbers.of(shape, "radius", 1, {kind == "capsule" ? 0.5 : 1.0, 0, 0}).x;
  const double length_m = numbers.of(shape, kind == "polyline" ? "height" : "length", 1, {1, 0, 0}).x;
  const Vec3 normal = numbers.of(shape, "normal", 3, {0, 0, 1});
  const Vec3 scale = numbers.of(shape, "scale", 3, {1, 1, 1});
  const bool is_line = kind == "polyline";
  Outcome<MeshShape> surface =
      is_line && is_shape_size(length_m) ? extruded(numbers, shape, length_m) : MeshShape{};
  if (numbers.fault()) return tl::unexpected(*numbers.fault());
  if (kind == "plane") {
    if (!is_scale(norm(normal))) return bad_input("its plane's normal is no direction; write e.g. 0 0 1");
    return Pieces{{HalfSpaceShape{}, {{}, upward(normal)}}};
  }
  if (kind == "mesh") surface = mesh_shape(files, file, shape, mesh, scale, meshes);
  if (!surface) return pass_on(surface);
  if (kind == "mesh") return Pieces{{std::move(*surface)}};
  if (!is_solid_size(size) || !is_shape_size(radius_m) || !is_shape_size(length_m))
    return bad_input("its size is not above 0 and at most 1e6 m; correct it");
  if (kind == "box") return Pieces{{BoxShape{0.5 * size}}};
  if (kind == "sphere") return Pieces{{SphereShape{radius_m}}};
  if (one_of(kind, {"cylinder", "capsule"})) return round_pieces(kind, radius_m, length_m);
  if (kind == "ellipsoid") surface = ellipsoid(size);
  if (kind == "cone") surface = cone(radius_m, length_m);
  if (surface->triangles.empty()) {
    files.warnings.add(file.document.where(shape), "a polyline that encloses nothing was left out");
    return Pieces{};
  }
  if (auto counted = count_triangles(meshes, surface->triangles.size()); !counted) return pass_on(counted);
  return Pieces{{std::move(*surface)}};
}

}  // namespace outrider
