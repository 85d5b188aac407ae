// Random polygon worlds, and slow answers about them that share nothing with the planners.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "outrider/core/rng.hpp"
#include "outrider/core/units.hpp"
#include "outrider/path/visibility/polygon_ground.hpp"

namespace outrider::testing {

struct PolygonWorld {
  std::vector<Vec2> boundary;
  std::vector<std::vector<Vec2>> obstacles;
  double radius_m = 0.18;
};

inline std::vector<Segment> edges_of(const PolygonWorld& world) {
  std::vector<Segment> edges;
  const auto add = [&](const std::vector<Vec2>& p) {
    for (std::size_t i = 0; i < p.size(); ++i) edges.push_back({p[i], p[(i + 1) % p.size()]});
  };
  add(world.boundary);
  for (const auto& obstacle : world.obstacles) add(obstacle);
  return edges;
}

inline bool winds_round(const std::vector<Vec2>& polygon, Vec2 p) {
  double sum = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    sum += wrap_angle(heading_of(polygon[(i + 1) % polygon.size()] - p) - heading_of(polygon[i] - p));
  }
  return std::abs(sum) > pi;
}

/// Distance to the nearest edge; negative in solid ground.
inline double room(const PolygonWorld& world, const std::vector<Segment>& edges, Vec2 p) {
  double least = 1e300;
  for (const Segment& edge : edges) least = std::min(least, distance(p, edge));
  bool solid = !winds_round(world.boundary, p);
  for (const auto& obstacle : world.obstacles) solid = solid || winds_round(obstacle, p);
  return solid ? -least : least;
}

/// Squares of a lattice that touch, share edges and corners, and leave gaps of whole metres.
inline PolygonWorld lattice_world(Rng& rng, int side, double share) {
  PolygonWorld world;
  const double s = side;
  world.boundary = {{0, 0}, {0, s}, {s, s}, {s, 0}};
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      if (rng.uniform() > share) continue;
      const double a = x, b = y;
      switch (rng.below(6)) {
        case 0: world.obstacles.push_back({{a, b}, {a + 1, b}, {a, b + 1}}); break;
        case 1: world.obstacles.push_back({{a + 1, b}, {a + 1, b + 1}, {a, b}}); break;
        case 2:  // a straight corner, and a second polygon in the same cell
          world.obstacles.push_back({{a, b}, {a + 0.5, b}, {a + 1, b}, {a + 1, b + 1}});
          world.obstacles.push_back({{a, b}, {a + 1, b + 1}, {a, b + 1}});
          break;
        default: world.obstacles.push_back({{a, b}, {a, b + 1}, {a + 1, b + 1}, {a + 1, b}}); break;
      }
    }
  }
  const double radii[] = {0.18, 0.25, 0.4, 0.5, 0.6, 0.05, std::sqrt(0.125)};
  world.radius_m = radii[rng.below(7)];
  return world;
}

/// Stars and slivers anywhere, which may overlap each other and the boundary.
inline PolygonWorld scattered_world(Rng& rng, int most) {
  PolygonWorld world;
  world.boundary = {{-5, -5}, {5, -5}, {5, 5}, {-5, 5}};
  if (rng.below(2) == 0) world.boundary = {{-5, -5}, {5, -5}, {5, 5}, {1, 1.5}, {-5, 5}};
  for (int k = 1 + static_cast<int>(rng.below(static_cast<std::uint64_t>(most))); k > 0; --k) {
    const Vec2 centre{rng.uniform(-5, 5), rng.uniform(-5, 5)};
    std::vector<double> headings;
    for (std::uint64_t i = 3 + rng.below(6); i > 0; --i) headings.push_back(rng.uniform(0.0, 2.0 * pi));
    std::sort(headings.begin(), headings.end());
    std::vector<Vec2> corners;
    for (const double heading : headings)
      corners.push_back(centre + rng.uniform(0.3, 1.8) * direction(heading));
    if (rng.below(2) == 0) std::reverse(corners.begin(), corners.end());
    if (check_polygon(corners, "it")) world.obstacles.push_back(corners);
  }
  world.radius_m = rng.below(4) == 0 ? 0.01 : rng.uniform(0.05, 0.5);
  return world;
}

inline PolygonWorld random_world(Rng& rng) {
  switch (rng.below(3)) {
    case 0: return lattice_world(rng, 3 + static_cast<int>(rng.below(6)), rng.uniform(0.1, 0.5));
    case 1: return scattered_world(rng, 12);
    default: return scattered_world(rng, 4);
  }
}

inline Vec2 random_place(Rng& rng, const PolygonWorld& world) {
  Box2 box;
  for (const Vec2 p : world.boundary) box.include(p);
  const Vec2 p{rng.uniform(box.low.x, box.high.x), rng.uniform(box.low.y, box.high.y)};
  return rng.below(3) == 0 ? Vec2{std::round(2.0 * p.x) / 2.0, std::round(2.0 * p.y) / 2.0} : p;
}

/// Returns true if cells, taken as free when any point of them may be, join the two. No means: surely no
/// path.
inline bool flood_joins(const PolygonWorld& world, Vec2 from, Vec2 to, double cell_m) {
  Box2 box;
  for (const Vec2 p : world.boundary) box.include(p);
  const std::vector<Segment> edges = edges_of(world);
  const int w = 1 + static_cast<int>(box.size().x / cell_m), h = 1 + static_cast<int>(box.size().y / cell_m);
  std::vector<char> state(static_cast<std::size_t>(w * h), 2);  // 2 unknown, 0 blocked or seen
  const auto cell = [&](Vec2 p) {
    const int x = std::clamp(static_cast<int>((p.x - box.low.x) / cell_m), 0, w - 1);
    const int y = std::clamp(static_cast<int>((p.y - box.low.y) / cell_m), 0, h - 1);
    return y * w + x;
  };
  const int goal = cell(to);
  std::vector<int> open{cell(from)};
  state[static_cast<std::size_t>(open[0])] = 0;
  while (!open.empty()) {
    const int at = open.back();
    open.pop_back();
    if (at == goal) return true;
    for (int i = 0; i < 9; ++i) {
      const int x = at % w + i % 3 - 1, y = at / w + i / 3 - 1;
      if (x < 0 || y < 0 || x >= w || y >= h) continue;
      char& next = state[static_cast<std::size_t>(y * w + x)];
      if (next == 0) continue;
      next = 0;
      const Vec2 centre = box.low + cell_m * Vec2{x + 0.5, y + 0.5};
      if (room(world, edges, centre) >= world.radius_m - 0.7072 * cell_m) open.push_back(y * w + x);
    }
  }
  return false;
}

}  // namespace outrider::testing
