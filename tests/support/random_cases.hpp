// How many random cases a test tries, and the shapes it tries them on.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include "outrider/core/rng.hpp"
#include "outrider/core/units.hpp"
#include "outrider/geometry/convex.hpp"

namespace outrider::testing {

/// `usual` cases in an ordinary run; OUTRIDER_CASES=100 makes them 100 times as many.
inline int cases(int usual) {
  const char* factor = std::getenv("OUTRIDER_CASES");
  return factor == nullptr ? usual : usual * std::max(1, std::atoi(factor));
}

inline Vec2 random_point(Rng& rng, double half_side) {
  return {rng.uniform(-half_side, half_side), rng.uniform(-half_side, half_side)};
}

inline std::vector<Vec2> random_convex_polygon(Rng& rng, double half_side) {
  std::vector<Vec2> points;
  while (points.size() < 3) {
    points.assign(3 + rng.below(8), Vec2{});
    const Vec2 centre = random_point(rng, half_side);
    for (Vec2& p : points) p = centre + random_point(rng, 0.5 * half_side);
    points = convex_hull(points);
  }
  return points;
}

/// Corners of a robot: a convex polygon around the origin.
inline std::vector<Vec2> random_outline(Rng& rng, double half_side) {
  std::vector<Vec2> points;
  const auto around = [&] {
    return points.size() >= 3 && signed_distance(Vec2{}, RoundedPolygon{points, 0.0}) < -0.01 * half_side;
  };
  while (!around()) {
    points.assign(3 + rng.below(5), Vec2{});
    for (Vec2& p : points) p = random_point(rng, half_side);
    points = convex_hull(points);
  }
  return points;
}

/// A disk, a capsule or a rounded polygon; sharp in a third of the cases.
inline RoundedPolygon random_rounded_polygon(Rng& rng, double half_side) {
  std::vector<Vec2> core = random_convex_polygon(rng, half_side);
  const std::uint64_t kind = rng.below(4);
  if (kind < 2) core.resize(kind + 1);
  return {core, rng.below(3) == 0 ? 0.0 : rng.uniform(0.0, 0.5 * half_side)};
}

/// True inside a convex, counter-clockwise polygon; `slack` widens it.
inline bool inside(Vec2 p, const std::vector<Vec2>& polygon, double slack = 0.0) {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i];
    const Vec2 edge = polygon[(i + 1) % polygon.size()] - a;
    if (cross(edge, p - a) < -slack * norm(edge)) return false;
  }
  return polygon.size() >= 3;
}

inline double area_of(const std::vector<Vec2>& polygon) {
  double twice = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    twice += cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  return 0.5 * twice;
}

}  // namespace outrider::testing
