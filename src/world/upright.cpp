#include "outrider/world/upright.hpp"

#include <algorithm>
#include <cmath>

namespace outrider {
namespace {

constexpr double rectangle_m = 2e-4;    ///< largest distance of the corners of a rectangle from those given
constexpr double inner_floor_m = 0.15;  ///< height of the inner floor above the foot, within a robot's body

bool is_rectangle(const std::vector<Vec2>& c) {
  if (c.size() != 4) return false;
  const Vec2 missing = c[0] + c[2] - c[1] - c[3];
  const double longer = std::max(distance(c[0], c[1]), distance(c[1], c[2]));
  const double skew = std::abs(dot(c[1] - c[0], c[2] - c[1])) / longer;
  return norm(missing) <= rectangle_m && skew <= rectangle_m;
}

/// Makes the sides of a prism, and a floor inside it, so that no robot can start there.
MeshShape prism(const std::vector<Vec2>& corners, Vec2 centre, double half_height_m) {
  MeshShape mesh;
  const auto at = [&](std::size_t i, double z) {
    const Vec2 p = corners[i % corners.size()] - centre;
    return Vec3{p.x, p.y, z};
  };
  const double floor_m = std::min(-half_height_m + inner_floor_m, 0.0);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3 low_a = at(i, -half_height_m);
    const Vec3 high_b = at(i + 1, half_height_m);
    mesh.triangles.push_back({low_a, at(i + 1, -half_height_m), high_b});
    mesh.triangles.push_back({low_a, high_b, at(i, half_height_m)});
    if (i >= 2) mesh.triangles.push_back({at(0, floor_m), at(i - 1, floor_m), at(i, floor_m)});
  }
  return mesh;
}

}  // namespace

Solid upright(const std::vector<Vec2>& c, const std::string& name, double z_low_m, double z_high_m) {
  const double half_height_m = 0.5 * (z_high_m - z_low_m);
  const double z_m = 0.5 * (z_low_m + z_high_m);
  const auto placed = [&](Vec2 centre, Vec2 along, Shape shape) {
    return Solid{
        name, {{centre.x, centre.y, z_m}, Rotation::from_rpy(0.0, 0.0, heading_of(along))}, std::move(shape)};
  };
  if (c.size() == 2) {
    const Vec3 half{0.5 * distance(c[0], c[1]), 0.0, half_height_m};
    return placed(0.5 * (c[0] + c[1]), c[1] - c[0], BoxShape{half});
  }
  Vec2 centre;
  for (const Vec2 corner : c) centre = centre + 1.0 / static_cast<double>(c.size()) * corner;
  if (!is_rectangle(c)) return placed(centre, {1.0, 0.0}, prism(c, centre, half_height_m));
  const Vec2 along = c[1] - c[0] + c[2] - c[3];
  const Vec2 across = c[2] - c[1] + c[3] - c[0];
  return placed(centre, along, BoxShape{{0.25 * norm(along), 0.25 * norm(across), half_height_m}});
}

}  // namespace outrider
