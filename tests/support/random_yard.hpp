// Small yards with solids of every kind, for tests that compare with brute force.
#pragma once

#include <fmt/format.h>

#include <array>
#include <vector>

#include "outrider/ballistics/target.hpp"
#include "outrider/core/rng.hpp"
#include "outrider/core/units.hpp"
#include "outrider/world/solid.hpp"

namespace outrider::testing {

inline Solid floor_at(double z) { return {"floor", {{0, 0, z}, {}}, HalfSpaceShape{}}; }

inline Solid box_at(std::string name, Vec3 centre, Vec3 size, double yaw = 0.0) {
  return {std::move(name), {centre, Rotation::from_rpy(0, 0, yaw)}, BoxShape{0.5 * size}};
}

/// In any direction.
inline Vec2 random_offset(Rng& rng, double least_m, double most_m) {
  const Vec2 along = direction(rng.uniform(-pi, pi));
  return rng.uniform(least_m, most_m) * along;
}

inline MeshShape tetrahedron(double size) {
  const std::array<Vec3, 4> c{Vec3{size, size, size}, Vec3{size, -size, -size}, Vec3{-size, size, -size},
                              Vec3{-size, -size, size}};
  return {{{c[0], c[1], c[2]}, {c[0], c[3], c[1]}, {c[0], c[2], c[3]}, {c[1], c[3], c[2]}}};
}

/// Upright box, turned box, upright or tilted cylinder, sphere, tetrahedron, thin wall: by `kind` of 0..6.
inline Solid random_solid(Rng& rng, std::uint64_t kind, double half_side) {
  const Vec3 where{rng.uniform(-half_side, half_side), rng.uniform(-half_side, half_side),
                   rng.uniform(0.0, 0.7)};
  const double yaw = rng.uniform(-pi, pi);
  const double roll = rng.uniform(-pi, pi);
  const Rotation any = Rotation::from_rpy(roll, rng.uniform(-1.5, 1.5), yaw);
  const Rotation upright = Rotation::from_rpy(0.0, 0.0, yaw);
  const Vec3 half{rng.uniform(0.05, 0.35), rng.uniform(0.05, 0.35), rng.uniform(0.05, 0.4)};
  const double radius = rng.uniform(0.04, 0.3);
  switch (kind) {
    case 0: return {"box", {where, upright}, BoxShape{half}};
    case 1: return {"turned_box", {where, any}, BoxShape{half}};
    case 2: return {"post", {where, upright}, CylinderShape{radius, half.z}};
    case 3: return {"log", {where, any}, CylinderShape{radius, half.z}};
    case 4: return {"sphere", {where, any}, SphereShape{radius}};
    case 5: return {"mesh", {where, any}, tetrahedron(radius)};
    default: return {"wall", {where, upright}, BoxShape{{0.002, 0.6, half.z}}};
  }
}

struct SmallYard {
  std::vector<Solid> solids;
  Target target;
};

/// A floor, some solids, and a target among them whose centre is free.
inline SmallYard random_small_yard(Rng& rng, std::size_t solids, double half_side) {
  static constexpr std::array<Vec3, 4> sizes{Vec3{0.5, 0.205, 0.372}, Vec3{0.46, 0.36, 0.178},
                                             Vec3{0.51, 0.1372, 0.526}, Vec3{0.2576, 0.164, 0.3712}};
  SmallYard yard{{floor_at(0.0)}, {}};
  yard.target = {
      "cat",
      {rng.uniform(-1.0, 1.0), rng.uniform(-1.0, 1.0), rng.below(2) == 0 ? 0.0 : rng.uniform(0.0, 0.8)},
      sizes[rng.below(4)],
      rng.uniform(-pi, pi)};
  while (yard.solids.size() <= solids) {
    const Solid solid = random_solid(rng, rng.below(7), half_side);
    if (distance(yard.target.centre(), solid) > 0.05) yard.solids.push_back(solid);
  }
  return yard;
}

}  // namespace outrider::testing
