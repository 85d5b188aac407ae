// Solids of a loaded world, by name.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "outrider/world/world.hpp"

namespace outrider {

inline const Solid& solid(const World& world, const std::string& name) {
  const auto found = std::ranges::find(world.solids, name, &Solid::name);
  static const Solid none;
  EXPECT_NE(found, world.solids.end()) << name;
  return found == world.solids.end() ? none : *found;
}

inline void expect_near(Vec3 a, Vec3 b, double tolerance = 1e-12) {
  EXPECT_NEAR(norm(a - b), 0.0, tolerance) << a.x << ' ' << a.y << ' ' << a.z;
}

}  // namespace outrider
