// A box on the floor, by the corners of its base, m.
#pragma once

#include <string>

#include "outrider/world/solid.hpp"

namespace outrider::testing {

inline Solid box(const std::string& name, Vec2 low, Vec2 high, double height_m = 0.5) {
  const Vec2 middle = 0.5 * (low + high), half = 0.5 * (high - low);
  return {name, {{middle.x, middle.y, 0.5 * height_m}, {}}, BoxShape{{half.x, half.y, 0.5 * height_m}}};
}

}  // namespace outrider::testing
