// Made-up ground, and what it is by another count.
#pragma once

#include <cmath>
#include <memory>
#include <vector>

#include "outrider/core/rng.hpp"
#include "outrider/world/height_field.hpp"

namespace outrider::testing {

/// Posts of a function of the place.
template <class Height>
HeightField terrain_of(Vec2 low, Vec2 spacing_m, int columns, int rows, Height height) {
  std::vector<double> heights;
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      heights.push_back(height(low + Vec2{x * spacing_m.x, y * spacing_m.y}));
    }
  }
  return HeightField::make(low, spacing_m, columns, rows, std::move(heights)).value();
}

/// Rough ground of 2 to 12 posts a side.
inline HeightField random_terrain(Rng& rng) {
  const Vec2 spacing{rng.uniform(0.2, 1.5), rng.uniform(0.2, 1.5)};
  const int columns = 2 + static_cast<int>(rng.below(11));
  const int rows = 2 + static_cast<int>(rng.below(11));
  return terrain_of({rng.uniform(-3.0, 3.0), rng.uniform(-3.0, 3.0)}, spacing, columns, rows,
                    [&](Vec2) { return rng.uniform(-1.0, 1.0); });
}

/// A round hill: its top in the origin, its foot `foot_m` away from there, on a plain of height 0.
inline HeightField hill(double half_side, double spacing_m, double top_m, double foot_m) {
  const int posts = static_cast<int>(std::lround(2.0 * half_side / spacing_m)) + 1;
  return terrain_of({-half_side, -half_side}, {spacing_m, spacing_m}, posts, posts, [&](Vec2 p) {
    const double part = std::min(1.0, norm(p) / foot_m);
    return top_m * (1.0 - part * part * (3.0 - 2.0 * part));
  });
}

/// The height by the plane through the three posts around p, found from their places.
inline double height_by_plane(const HeightField& field, Vec2 p) {
  for (int y = 0; y + 1 < field.rows(); ++y) {
    for (int x = 0; x + 1 < field.columns(); ++x) {
      const Vec3 low = field.post(x, y);
      const Vec3 high = field.post(x + 1, y + 1);
      if (p.x < low.x || p.y < low.y || p.x > high.x || p.y > high.y) continue;
      const bool right = cross(xy(high) - xy(low), p - xy(low)) <= 0.0;
      const Vec3 side = right ? field.post(x + 1, y) : field.post(x, y + 1);
      const Vec3 normal = cross(side - low, high - low);
      return low.z - dot(xy(normal), p - xy(low)) / normal.z;
    }
  }
  return std::nan("");
}

}  // namespace outrider::testing
