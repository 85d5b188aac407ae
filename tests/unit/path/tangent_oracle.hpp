// Brute force for shortest paths of a disk among polygons: all tangents of all corner circles, all arcs
// between their ends, each judged by samples against every edge; then the quadratic Dijkstra.
#pragma once

#include <limits>

#include "polygon_worlds.hpp"

namespace outrider::testing {

struct TangentOracle {
  static constexpr double tolerance_m = 1e-7;

  const PolygonWorld& world;
  std::vector<Segment> edges = edges_of(world);

  [[nodiscard]] bool free(Vec2 p) const { return room(world, edges, p) >= world.radius_m - tolerance_m; }
  [[nodiscard]] bool leg_free(Vec2 a, Vec2 b) const {
    if (!free(a) || !free(b)) return false;
    return std::all_of(edges.begin(), edges.end(), [&](const Segment& edge) {
      return distance(Segment{a, b}, edge) >= world.radius_m - tolerance_m;
    });
  }
  /// From one heading counter-clockwise to another, about a corner.
  [[nodiscard]] bool arc_free(Vec2 centre, double from, double turn) const {
    const int samples = 1 + static_cast<int>(turn / 0.01);
    for (int i = 0; i <= samples; ++i) {
      if (!free(centre + world.radius_m * direction(from + turn * i / samples))) return false;
    }
    return true;
  }

  struct End {  ///< of a leg: on a circle, at a heading from its centre, going round to one side
    std::size_t circle = 0;
    double heading = 0.0;
    int side = 0;  ///< 1 counter-clockwise, -1 clockwise, 0 at the start and the goal
    bool arrival = false;
    Vec2 at;
  };
  struct Link {
    std::size_t from, to;
    double length;
  };

  [[nodiscard]] double shortest(Vec2 start, Vec2 goal) const;
  void add_legs(const std::vector<Vec2>& centres, std::size_t i, std::size_t j, std::vector<End>& ends,
                std::vector<Link>& links) const;
};

/// Legs from circle i to circle j; circles 0 and 1 are the start and the goal.
inline void TangentOracle::add_legs(const std::vector<Vec2>& centres, std::size_t i, std::size_t j,
                                    std::vector<End>& ends, std::vector<Link>& links) const {
  const Vec2 v = centres[j] - centres[i];
  const double apart = norm(v);
  if (apart == 0.0) return;
  const std::vector<int> sides{1, -1}, none{0};
  for (const int a : i < 2 ? none : sides) {
    for (const int b : j < 2 ? none : sides) {
      const double part = world.radius_m * (a - b) / apart;
      if (std::abs(part) > 1.0) continue;
      const double heading = heading_of(v) + std::asin(part);
      const double from = heading - a * 0.5 * pi, to = heading - b * 0.5 * pi;
      const Vec2 p = centres[i] + (a == 0 ? 0.0 : world.radius_m) * direction(from);
      const Vec2 q = centres[j] + (b == 0 ? 0.0 : world.radius_m) * direction(to);
      if (!leg_free(p, q)) continue;
      ends.push_back({i, from, a, false, p});
      ends.push_back({j, to, b, true, q});
      links.push_back({ends.size() - 2, ends.size() - 1, distance(p, q)});
    }
  }
}

inline double TangentOracle::shortest(Vec2 start, Vec2 goal) const {
  if (!free(start) || !free(goal)) return -1.0;
  std::vector<Vec2> centres{start, goal};
  for (const Segment& edge : edges) {
    if (std::find(centres.begin() + 2, centres.end(), edge.a) == centres.end()) centres.push_back(edge.a);
  }
  std::vector<End> ends;
  std::vector<Link> links;
  for (std::size_t i = 0; i < centres.size(); ++i) {
    for (std::size_t j = 0; j < centres.size(); ++j) {
      if (i != j && i != 1 && j != 0) add_legs(centres, i, j, ends, links);
    }
  }
  for (std::size_t i = 0; i < ends.size(); ++i) {
    for (std::size_t j = 0; j < ends.size(); ++j) {
      const End &a = ends[i], &b = ends[j];
      if (!a.arrival || b.arrival || a.circle != b.circle || a.side != b.side || a.side == 0) continue;
      double turn = a.side * (b.heading - a.heading);
      turn -= 2.0 * pi * std::floor(turn / (2.0 * pi));
      if (turn > 2.0 * pi - 1e-7) turn = 0.0;
      if (turn >= pi || !arc_free(centres[a.circle], a.side > 0 ? a.heading : b.heading, turn)) continue;
      links.push_back({i, j, world.radius_m * turn});
    }
  }
  const double infinite = std::numeric_limits<double>::infinity();
  std::vector<double> cost(ends.size(), infinite);
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (ends[i].circle == 0) cost[i] = 0.0;
  }
  for (bool changed = true; changed;) {
    changed = false;
    for (const Link& link : links) {
      if (cost[link.from] + link.length >= cost[link.to] - 1e-13) continue;
      cost[link.to] = cost[link.from] + link.length;
      changed = true;
    }
  }
  double least = infinite;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    if (ends[i].circle == 1) least = std::min(least, cost[i]);
  }
  return least;
}

}  // namespace outrider::testing
