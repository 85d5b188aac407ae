// Axis-aligned boxes in the plane and in space. A default box is empty.
#pragma once

#include <algorithm>
#include <limits>

#include "outrider/geometry/vec.hpp"

namespace outrider {

struct Box2 {
  Vec2 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Vec2 high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

  constexpr void include(Vec2 p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  [[nodiscard]] constexpr bool empty() const { return low.x > high.x || low.y > high.y; }
  [[nodiscard]] constexpr Vec2 size() const { return high - low; }
  [[nodiscard]] constexpr Box2 grown(double by) const {
    return {{low.x - by, low.y - by}, {high.x + by, high.y + by}};
  }
  [[nodiscard]] constexpr bool contains(Vec2 p) const {
    return p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y;
  }
  /// Returns the distance from p to the box; 0 inside.
  [[nodiscard]] double distance_to(Vec2 p) const {
    return norm(Vec2{std::max({0.0, low.x - p.x, p.x - high.x}), std::max({0.0, low.y - p.y, p.y - high.y})});
  }
  [[nodiscard]] constexpr bool overlaps(const Box2& o) const {
    return low.x <= o.high.x && o.low.x <= high.x && low.y <= o.high.y && o.low.y <= high.y;
  }
};

struct Box3 {
  Vec3 low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
           std::numeric_limits<double>::infinity()};
  Vec3 high{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
            -std::numeric_limits<double>::infinity()};

  constexpr void include(Vec3 p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  [[nodiscard]] constexpr Box2 ground() const { return {xy(low), xy(high)}; }
};

}  // namespace outrider
