#include "visibility_tangents.hpp"

#include <algorithm>
#include <cmath>

#include "outrider/core/units.hpp"

namespace outrider {
namespace {

Vec2 right_of(Vec2 v) { return {v.y, -v.x}; }

}  // namespace

Place place_of(const PolygonGround& ground, Node node) {
  const FreeArc& arc = ground.arcs[node / 2];
  return {arc.centre, ground.radius_m, node % 2 == 0 ? 1.0 : -1.0, &arc};
}

std::optional<Tangent> tangent(const Place& a, const Place& b) {
  const Vec2 v = b.centre - a.centre;
  const double apart = squared_norm(v);
  const double aside = a.radius_m * a.side - b.radius_m * b.side;
  const double squared_length = apart - aside * aside;
  // If circles touch, or a point lies on a circle, the tangent between them has length zero.
  if (apart == 0.0 || squared_length < -4.0 * std::max(a.radius_m, b.radius_m) * contact_m)
    return std::nullopt;
  const double length = std::sqrt(std::max(0.0, squared_length));
  const double scale = squared_length > 0.0 ? 1.0 / apart : 1.0 / (std::abs(aside) * std::sqrt(apart));
  const Vec2 along = scale * (length * v + aside * perpendicular(v));
  return Tangent{along, length, a.centre + a.radius_m * a.side * right_of(along),
                 b.centre + b.radius_m * b.side * right_of(along)};
}

bool touches_arc(const Place& place, Vec2 along) {
  if (place.arc == nullptr) return true;
  const Vec2 outwards = place.side * right_of(along);
  return dot(outwards, place.arc->middle) > 0.0 && cross(place.arc->first, outwards) >= -tangent_slack_rad &&
         cross(outwards, place.arc->last) >= -tangent_slack_rad;
}

double progress(const Place& place, Vec2 along) {
  if (place.arc == nullptr) return 0.0;
  const Vec2 outwards = place.side * right_of(along);
  const Vec2 begin = place.side > 0.0 ? place.arc->first : place.arc->last;
  const double turned = place.side * std::atan2(cross(begin, outwards), dot(begin, outwards));
  return std::clamp(turned, 0.0, place.arc->width_rad);
}

Vec2 point_at(const Place& place, double progress_rad) {
  if (place.arc == nullptr) return place.centre;
  const double begin = place.arc->from_rad + (place.side > 0.0 ? 0.0 : place.arc->width_rad);
  return place.centre + place.radius_m * direction(begin + place.side * progress_rad);
}

std::optional<Departure> departure(const PolygonGround& ground, const Place& place, Node to,
                                   std::uint64_t& tests) {
  const Place other = place_of(ground, to);
  const auto leg = tangent(place, other);
  if (!leg || !touches_arc(place, leg->along) || !touches_arc(other, leg->along)) return std::nullopt;
  ++tests;
  if (!ground.segment_free({leg->from, leg->to})) return std::nullopt;
  return Departure{to, progress(place, leg->along), progress(other, leg->along), leg->length, leg->to};
}

void departures_pairwise(const PolygonGround& ground, const Place& place, Node least,
                         std::vector<Departure>& found, std::uint64_t& tests) {
  const auto nodes = static_cast<Node>(2 * ground.arcs.size());
  for (Node to = least; to < nodes; ++to) {
    if (const auto leg = departure(ground, place, to, tests)) found.push_back(*leg);
  }
}

}  // namespace outrider
