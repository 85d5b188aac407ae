#include "outrider/navigate/allowed_ground.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "outrider/geometry/convex.hpp"

namespace outrider {
namespace {

template <class Visit>
void for_each_edge(const std::vector<std::vector<Vec2>>& rings, Visit visit) {
  for (const auto& ring : rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) visit(ring[i], ring[(i + 1) % ring.size()]);
  }
}

}  // namespace

AllowedGround::AllowedGround(std::vector<std::vector<Vec2>> rings) : rings_(std::move(rings)) {}

bool AllowedGround::contains(Vec2 place) const {
  bool inside = false;
  for_each_edge(rings_, [&](Vec2 a, Vec2 b) {
    if ((a.y > place.y) == (b.y > place.y)) return;
    const double x = a.x + (place.y - a.y) / (b.y - a.y) * (b.x - a.x);
    if (x > place.x) inside = !inside;
  });
  return inside;
}

double AllowedGround::to_edge_m(Vec2 place) const {
  double least = std::numeric_limits<double>::infinity();
  for_each_edge(rings_, [&](Vec2 a, Vec2 b) { least = std::min(least, distance(place, Segment{a, b})); });
  return least;
}

std::vector<Vec2> AllowedGround::edge_points(double step_m) const {
  std::vector<Vec2> points;
  for_each_edge(rings_, [&](Vec2 a, Vec2 b) {
    const auto steps = std::max(1.0, std::ceil(distance(a, b) / step_m));
    for (double i = 0.0; i < steps; ++i) points.push_back(a + i / steps * (b - a));
  });
  return points;
}

}  // namespace outrider
