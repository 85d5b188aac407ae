// A second opinion on flights: small steps of an integrator, and distances written apart from the library.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "outrider/ballistics/shot.hpp"
#include "outrider/world/height_field.hpp"
#include "outrider/world/solid.hpp"

namespace outrider::testing {

inline double distance_to_segment(Vec3 p, Vec3 a, Vec3 b) {
  const Vec3 along = b - a;
  const double length2 = squared_norm(along);
  const double t = length2 > 0.0 ? std::clamp(dot(p - a, along) / length2, 0.0, 1.0) : 0.0;
  return norm(p - (a + t * along));
}

inline double distance_to_face(Vec3 p, const std::array<Vec3, 3>& t) {
  const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
  bool above = squared_norm(n) > 0.0;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 a = t[i];
    const Vec3 b = t[(i + 1) % 3];
    above = above && dot(cross(b - a, p - a), n) >= 0.0;
    nearest = std::min(nearest, distance_to_segment(p, a, b));
  }
  return above ? std::abs(dot(p - t[0], n)) / norm(n) : nearest;
}

/// Distance from a point to a solid, by the point of the solid that is nearest.
inline double own_distance(Vec3 world, const Solid& solid) {
  const Pose3& pose = solid.world_T_solid;
  const Vec3 d = world - pose.position;
  const Vec3 p{dot(d, pose.rotation.axes[0]), dot(d, pose.rotation.axes[1]), dot(d, pose.rotation.axes[2])};
  if (const auto* box = std::get_if<BoxShape>(&solid.shape)) {
    const Vec3 h = box->half_size;
    return norm(p - Vec3{std::clamp(p.x, -h.x, h.x), std::clamp(p.y, -h.y, h.y), std::clamp(p.z, -h.z, h.z)});
  }
  if (const auto* cylinder = std::get_if<CylinderShape>(&solid.shape)) {
    const double r = std::hypot(p.x, p.y);
    const double shrink = r > cylinder->radius_m ? cylinder->radius_m / r : 1.0;
    const double z = std::clamp(p.z, -cylinder->half_length_m, cylinder->half_length_m);
    return norm(p - Vec3{shrink * p.x, shrink * p.y, z});
  }
  if (const auto* sphere = std::get_if<SphereShape>(&solid.shape)) {
    return std::max(0.0, norm(p) - sphere->radius_m);
  }
  if (std::holds_alternative<HalfSpaceShape>(solid.shape)) return std::max(0.0, p.z);
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& t : std::get<MeshShape>(solid.shape).triangles) {
    nearest = std::min(nearest, distance_to_face(p, t));
  }
  return nearest;
}

/// Radius of a ball around the origin of the solid's frame that holds it.
inline double own_radius(const Shape& shape) {
  if (const auto* box = std::get_if<BoxShape>(&shape)) return norm(box->half_size);
  if (const auto* c = std::get_if<CylinderShape>(&shape)) return std::hypot(c->radius_m, c->half_length_m);
  if (const auto* sphere = std::get_if<SphereShape>(&shape)) return sphere->radius_m;
  double radius = 0.0;
  if (const auto* mesh = std::get_if<MeshShape>(&shape)) {
    for (const auto& t : mesh->triangles) {
      for (const Vec3 corner : t) radius = std::max(radius, norm(corner));
    }
    return radius;
  }
  return std::numeric_limits<double>::infinity();
}

/// How a ball's flight ends, seen in small steps.
struct FineEnd {
  bool hit = false;  ///< the target came first
  double time_s = 0.0;
  Vec3 position;
  std::optional<std::size_t> solid;  ///< touched instead
  double gap_m = 0.0;                ///< least distance from the ball to any solid until then, up to 0.1 m
};

/// The accelerations of a ball: gravity, and the drag of air that moves with the wind.
struct FineLaw {
  double gravity_mps2 = 9.8;
  double drag_per_m = 0.0;
  Vec3 wind_mps = {};

  [[nodiscard]] Vec3 acceleration(Vec3 v) const {
    const Vec3 down{0, 0, -gravity_mps2};
    if (drag_per_m == 0.0) return down;
    const Vec3 u = v - wind_mps;
    return down - drag_per_m * norm(u) * u;
  }
};

/// Integrates the flight in steps of `step_m` until the ball touches the target or something else (which wins
/// when both happen in one step), or falls below `lowest_z`. `to_target(p, time_s)` and `to_ground(p)` are
/// distances from the centre of the ball; solids that are height fields are left to `to_ground`.
template <class ToTarget, class ToGround>
FineEnd fly_fine(Vec3 p, Vec3 v, const FineLaw& law, double ball_radius, const std::vector<Solid>& solids,
                 const ToTarget& to_target, const ToGround& to_ground, double lowest_z, double step_m) {
  constexpr double far = 0.1;
  std::vector<double> reach;
  for (const Solid& solid : solids) {
    const bool is_ground = std::holds_alternative<HeightFieldShape>(solid.shape);
    reach.push_back(is_ground ? 0.0 : own_radius(solid.shape) + ball_radius + far);
  }
  FineEnd end;
  end.gap_m = far;
  for (;;) {
    for (std::size_t i = 0; i < solids.size(); ++i) {
      if (squared_norm(p - solids[i].world_T_solid.position) > reach[i] * reach[i]) continue;
      if (reach[i] == 0.0) continue;
      const double gap = own_distance(p, solids[i]) - ball_radius;
      end.gap_m = std::min(end.gap_m, std::max(0.0, gap));
      if (gap <= 0.0 && !end.solid) end.solid = i;
    }
    if (!end.solid && to_ground(p) <= ball_radius) end.solid = solids.size();
    end.position = p;
    if (end.solid) return end;
    end.hit = to_target(p, end.time_s) <= ball_radius;
    if (end.hit || p.z < lowest_z) return end;
    const double dt = step_m / norm(v);
    const Vec3 later = v + dt * law.acceleration(v + 0.5 * dt * law.acceleration(v));
    p = p + 0.5 * dt * (v + later);
    v = later;
    end.time_s += dt;
  }
}

/// The same without air, at a target that stands still, on a floor that is a solid.
inline FineEnd fly_fine(Vec3 p, Vec3 v, double gravity, double ball_radius, const std::vector<Solid>& solids,
                        const Solid* target, double lowest_z, double step_m = 2e-4) {
  constexpr double never = std::numeric_limits<double>::infinity();
  const auto to_target = [&](Vec3 at, double) {
    return target != nullptr ? own_distance(at, *target) : never;
  };
  return fly_fine(
      p, v, FineLaw{gravity}, ball_radius, solids, to_target, [](Vec3) { return never; }, lowest_z, step_m);
}

/// A shot from the issue's own words: where the tip is at a pitch, and the speed that passes a point.
struct OwnGun {
  GunModel gun;
  double gravity = 9.8;

  [[nodiscard]] double ahead(double p) const {
    return gun.tip_forward_m * std::cos(p) - gun.tip_up_m * std::sin(p);
  }
  [[nodiscard]] double above(double p) const {
    return gun.pivot_height_m + gun.tip_forward_m * std::sin(p) + gun.tip_up_m * std::cos(p);
  }
  /// Nothing when no speed that the gun has passes the point.
  [[nodiscard]] std::optional<double> speed(double p, double range, double height) const {
    const double s = range - ahead(p);
    const double fall = above(p) + s * std::tan(p) - height;
    if (s <= 0.0 || fall <= 0.0) return {};
    const double t = std::sqrt(2.0 * fall / gravity);  // time to drop from the line of the barrel
    const double v = s / (t * std::cos(p));
    if (v > gun.muzzle_speed_mps) return {};
    return v;
  }
  [[nodiscard]] FineEnd shoot(Vec2 from, const Shot& shot, const std::vector<Solid>& solids,
                              const Solid* target, double lowest_z, double step_m = 2e-4) const {
    const double c = std::cos(shot.yaw_rad);
    const double s = std::sin(shot.yaw_rad);
    const double ahead_m = ahead(shot.pitch_rad);
    const double level = shot.speed_mps * std::cos(shot.pitch_rad);
    return fly_fine({from.x + ahead_m * c, from.y + ahead_m * s, above(shot.pitch_rad)},
                    {level * c, level * s, shot.speed_mps * std::sin(shot.pitch_rad)}, gravity,
                    gun.ball_radius_m, solids, target, lowest_z, step_m);
  }
};

}  // namespace outrider::testing
