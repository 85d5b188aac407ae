#include "polygon_clearance.hpp"

#include <algorithm>
#include <limits>

namespace outrider {
namespace {

constexpr double share = 1.0 / 8.0;

double clearance_from(const std::vector<Segment>& edges, Vec2 p) {
  double least = std::numeric_limits<double>::infinity();
  for (const Segment& edge : edges) least = std::min(least, distance(p, edge));
  return least;
}

}  // namespace

double leg_clearance(const PolygonGround& ground, const Segment& leg) {
  double least = std::numeric_limits<double>::infinity();
  for (const Segment& edge : ground.edges) least = std::min(least, distance(edge, leg));
  return least;
}

double leg_exposure(const PolygonGround& ground, const Segment& leg) {
  const double length = distance(leg.a, leg.b);
  const Vec2 middle = 0.5 * (leg.a + leg.b);
  const double reach = ground.edge_distance(middle) + length;  // nothing farther is nearest anywhere
  std::vector<Segment> near;
  for (const Segment& edge : ground.edges) {
    if (distance(middle, edge) <= reach) near.push_back(edge);
  }
  double sum = 0.0, at_a = clearance_from(near, leg.a);
  for (double walked = 0.0; walked < length;) {
    const double piece = std::min(share * at_a, length - walked);
    const auto at = [&](double along) {
      return clearance_from(near, leg.a + (walked + along) / length * (leg.b - leg.a));
    };
    const double at_b = at(piece);
    sum += piece / 6.0 * (1.0 / at_a + 4.0 / at(0.5 * piece) + 1.0 / at_b);
    walked = piece < length - walked ? walked + piece : length;
    at_a = at_b;
  }
  return sum;
}

}  // namespace outrider
