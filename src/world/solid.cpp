#include "outrider/world/solid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "outrider/core/overload.hpp"
#include "outrider/core/units.hpp"
#include "outrider/geometry/triangle.hpp"

namespace outrider {
namespace {

constexpr int prism_sides = 64;  // 1 / cos(pi / 64) = 1.0012: the 0.13 % of the header
constexpr double upright = 1.0 - 1e-12;

// ---- Distances, each in the frame of the solid -------------------------------------------------

double distance_local(Vec3 p, const BoxShape& box) {
  return norm({std::max(std::abs(p.x) - box.half_size.x, 0.0), std::max(std::abs(p.y) - box.half_size.y, 0.0),
               std::max(std::abs(p.z) - box.half_size.z, 0.0)});
}

double distance_local(Vec3 p, const CylinderShape& cylinder) {
  return norm(Vec2{std::max(norm(xy(p)) - cylinder.radius_m, 0.0),
                   std::max(std::abs(p.z) - cylinder.half_length_m, 0.0)});
}

double distance_local(Vec3 p, const SphereShape& sphere) { return std::max(norm(p) - sphere.radius_m, 0.0); }

double distance_local(Vec3 p, const HalfSpaceShape&) { return std::max(p.z, 0.0); }

double distance_local(Vec3 p, const HeightFieldShape& ground) { return ground.field->distance(p); }

double distance_local(Vec3 p, const MeshShape& mesh) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& triangle : mesh.triangles) {
    nearest = std::min(nearest, distance_to_triangle(p, triangle));
  }
  return nearest;
}

// ---- Convex pieces as corners and edges, in the world frame ------------------------------------

struct Polytope {
  std::vector<Vec3> corners;
  std::vector<std::pair<std::size_t, std::size_t>> edges;
};

Polytope polytope(const BoxShape& box, const Pose3& world_T_solid) {
  Polytope result;
  for (unsigned i = 0; i < 8; ++i) {
    const auto side = [i](unsigned bit, double half) { return (i >> bit & 1U) != 0 ? half : -half; };
    result.corners.push_back(
        world_T_solid * Vec3{side(0, box.half_size.x), side(1, box.half_size.y), side(2, box.half_size.z)});
    for (unsigned bit = 0; bit < 3; ++bit) {
      if ((i >> bit & 1U) == 0) result.edges.emplace_back(i, i | 1U << bit);
    }
  }
  return result;
}

/// Makes the prism around a cylinder.
Polytope polytope(const CylinderShape& cylinder, const Pose3& world_T_solid) {
  Polytope result;
  const double radius = cylinder.radius_m / std::cos(pi / prism_sides);
  for (std::size_t i = 0; i < prism_sides; ++i) {
    const Vec2 rim = radius * direction(2.0 * pi * static_cast<double>(i) / prism_sides);
    for (const double z : {-cylinder.half_length_m, cylinder.half_length_m}) {
      result.corners.push_back(world_T_solid * Vec3{rim.x, rim.y, z});
    }
    const std::size_t next = (i + 1) % prism_sides;
    result.edges.emplace_back(2 * i, 2 * i + 1);
    result.edges.emplace_back(2 * i, 2 * next);
    result.edges.emplace_back(2 * i + 1, 2 * next + 1);
  }
  return result;
}

Polytope polytope(const std::array<Vec3, 3>& triangle, const Pose3& world_T_solid) {
  return {{world_T_solid * triangle[0], world_T_solid * triangle[1], world_T_solid * triangle[2]},
          {{0, 1}, {1, 2}, {2, 0}}};
}

/// Projects the part of a polytope between two heights onto the ground.
std::vector<RoundedPolygon> shadow(const Polytope& piece, double z_low, double z_high) {
  std::vector<Vec2> points;
  for (const Vec3 c : piece.corners) {
    if (c.z >= z_low && c.z <= z_high) points.push_back(xy(c));
  }
  for (const auto& [i, j] : piece.edges) {
    const Vec3 a = piece.corners[i];
    const Vec3 b = piece.corners[j];
    for (const double z : {z_low, z_high}) {
      if ((a.z < z) != (b.z < z)) points.push_back(xy(a + (z - a.z) / (b.z - a.z) * (b - a)));
    }
  }
  if (points.empty()) return {};
  return {RoundedPolygon{convex_hull(std::move(points)), 0.0}};
}

/// Cuts a polytope with the vertical plane {origin + s along}.
std::vector<std::vector<Vec2>> cut_polytope(const Polytope& piece, Vec2 origin, Vec2 along) {
  const auto side = [&](Vec3 c) { return cross(along, xy(c) - origin); };
  std::vector<Vec2> points;
  for (const auto& [i, j] : piece.edges) {
    const Vec3 a = piece.corners[i];
    const Vec3 b = piece.corners[j];
    const double sa = side(a);
    const double sb = side(b);
    if ((sa < 0.0) == (sb < 0.0)) continue;
    const Vec3 p = a + sa / (sa - sb) * (b - a);
    points.push_back({dot(along, xy(p) - origin), p.z});
  }
  if (points.size() < 2) return {};
  return {convex_hull(std::move(points))};
}

/// Returns the ground under the line as columns, down to 1e3 m below its lowest point. Neighbouring columns
/// with the same slope are joined.
std::vector<std::vector<Vec2>> cut_ground(const HeightField& field, Vec2 origin, Vec2 along) {
  const Box2 box = field.bounds();
  const Vec2 corners[] = {box.low, {box.high.x, box.low.y}, box.high, {box.low.x, box.high.y}};
  const auto inside = cut({std::begin(corners), std::end(corners)}, origin, along, -1e7, 1e7);
  if (!inside) return {};
  const double bottom = field.lowest_m() - 1e3;
  std::vector<std::vector<Vec2>> columns;
  std::vector<Vec2> top;
  for (const Vec3 p : field.drape({origin + inside->low * along, origin + inside->high * along})) {
    const Vec2 here{dot(along, xy(p) - origin), p.z};
    const std::size_t n = top.size();
    if (n >= 2 && std::abs(cross(top[n - 1] - top[n - 2], here - top[n - 2])) < 1e-12) top.pop_back();
    top.push_back(here);
  }
  for (std::size_t i = 1; i < top.size(); ++i) {
    columns.push_back({{top[i - 1].x, bottom}, {top[i].x, bottom}, top[i], top[i - 1]});
  }
  return columns;
}

bool is_upright(const Pose3& pose) { return std::abs(pose.rotation.axes[2].z) >= upright; }

std::vector<Vec2> circle(Vec2 centre, double radius) {
  std::vector<Vec2> points;
  points.reserve(48);
  for (int i = 0; i < 48; ++i) points.push_back(centre + radius * direction(2.0 * pi * i / 48));
  return points;
}

}  // namespace

std::string_view kind(const Shape& shape) {
  constexpr std::string_view names[] = {"box", "cylinder", "sphere", "half_space", "mesh", "height_field"};
  return names[shape.index()];
}

double distance(Vec3 p, const Solid& solid) {
  const Vec3 local = solid.world_T_solid.to_local(p);
  return std::visit([local](const auto& shape) { return distance_local(local, shape); }, solid.shape);
}

Box3 bounds(const Solid& solid) {
  const Pose3& pose = solid.world_T_solid;
  Box3 box;
  const auto include_extent = [&](double hx, double hy, double hz) {
    box = {pose.position - Vec3{hx, hy, hz}, pose.position + Vec3{hx, hy, hz}};
  };
  const auto& axes = pose.rotation.axes;
  std::visit(Overload{[&](const BoxShape& b) {
                        const Vec3 h = b.half_size;
                        const auto extent = [&](double Vec3::* c) {
                          return std::abs(axes[0].*c) * h.x + std::abs(axes[1].*c) * h.y +
                                 std::abs(axes[2].*c) * h.z;
                        };
                        include_extent(extent(&Vec3::x), extent(&Vec3::y), extent(&Vec3::z));
                      },
                      [&](const CylinderShape& c) {
                        const auto extent = [&](double Vec3::* k) {
                          const double a = axes[2].*k;
                          return std::abs(a) * c.half_length_m +
                                 c.radius_m * std::sqrt(std::max(0.0, 1.0 - a * a));
                        };
                        include_extent(extent(&Vec3::x), extent(&Vec3::y), extent(&Vec3::z));
                      },
                      [&](const SphereShape& s) { include_extent(s.radius_m, s.radius_m, s.radius_m); },
                      [&](const HalfSpaceShape&) {
                        constexpr double inf = std::numeric_limits<double>::infinity();
                        const double up = axes[2].z;
                        box = {{-inf, -inf, up <= -upright ? pose.position.z : -inf},
                               {inf, inf, up >= upright ? pose.position.z : inf}};
                      },
                      [&](const HeightFieldShape& ground) {
                        const Box2 ground_box = ground.field->bounds();
                        constexpr double inf = std::numeric_limits<double>::infinity();
                        box = {{ground_box.low.x, ground_box.low.y, -inf},
                               {ground_box.high.x, ground_box.high.y, ground.field->highest_m()}};
                      },
                      [&](const MeshShape& m) {
                        for (const auto& triangle : m.triangles) {
                          for (const Vec3 corner : triangle) box.include(pose * corner);
                        }
                      }},
             solid.shape);
  return box;
}

std::vector<RoundedPolygon> footprint(const Solid& solid, double z_low_m, double z_high_m) {
  const Pose3& pose = solid.world_T_solid;
  const Vec3 centre = pose.position;
  using Pieces = std::vector<RoundedPolygon>;
  return std::visit(
      Overload{[&](const BoxShape& box) { return shadow(polytope(box, pose), z_low_m, z_high_m); },
               [&](const CylinderShape& c) -> Pieces {
                 if (!is_upright(pose)) return shadow(polytope(c, pose), z_low_m, z_high_m);
                 if (centre.z + c.half_length_m < z_low_m || centre.z - c.half_length_m > z_high_m) {
                   return {};
                 }
                 return {RoundedPolygon{{xy(centre)}, c.radius_m}};
               },
               [&](const SphereShape& s) -> Pieces {
                 const double dz = std::max({z_low_m - centre.z, centre.z - z_high_m, 0.0});
                 if (dz > s.radius_m) return {};
                 return {RoundedPolygon{{xy(centre)}, std::sqrt(s.radius_m * s.radius_m - dz * dz)}};
               },
               [](const HalfSpaceShape&) -> Pieces { return {}; },
               [](const HeightFieldShape&) -> Pieces { return {}; },
               [&](const MeshShape& mesh) {
                 Pieces pieces;
                 for (const auto& triangle : mesh.triangles) {
                   for (auto& piece : shadow(polytope(triangle, pose), z_low_m, z_high_m)) {
                     pieces.push_back(std::move(piece));
                   }
                 }
                 return pieces;
               }},
      solid.shape);
}

std::vector<std::vector<Vec2>> slice(const Solid& solid, Vec2 origin, Vec2 along) {
  const Pose3& pose = solid.world_T_solid;
  using Pieces = std::vector<std::vector<Vec2>>;
  return std::visit(
      Overload{[&](const BoxShape& box) { return cut_polytope(polytope(box, pose), origin, along); },
               [&](const CylinderShape& c) { return cut_polytope(polytope(c, pose), origin, along); },
               [&](const SphereShape& s) -> Pieces {
                 const Vec2 to_centre = xy(pose.position) - origin;
                 const double off = cross(along, to_centre);
                 if (std::abs(off) >= s.radius_m) return {};
                 return {circle({dot(along, to_centre), pose.position.z},
                                std::sqrt(s.radius_m * s.radius_m - off * off))};
               },
               [&](const HalfSpaceShape&) -> Pieces {
                 const Vec3 up = pose.rotation.axes[2];
                 const Vec2 normal{dot(along, xy(up)), up.z};
                 const double offset = dot(up, pose.position) - dot(xy(up), origin);
                 const double deep = pose.position.z - 1e3;
                 const double high = pose.position.z + 1e3;
                 auto piece = clip({{-1e3, deep}, {1e3, deep}, {1e3, high}, {-1e3, high}}, normal, offset);
                 return piece.empty() ? Pieces{} : Pieces{std::move(piece)};
               },
               [&](const HeightFieldShape& ground) { return cut_ground(*ground.field, origin, along); },
               [&](const MeshShape& mesh) {
                 Pieces pieces;
                 for (const auto& triangle : mesh.triangles) {
                   for (auto& piece : cut_polytope(polytope(triangle, pose), origin, along)) {
                     pieces.push_back(std::move(piece));
                   }
                 }
                 return pieces;
               }},
      solid.shape);
}

}  // namespace outrider
