#include "bisector.hpp"

#include <algorithm>
#include <cmath>

namespace outrider {
namespace {

Vec2 unit(Vec2 v) { return (1.0 / norm(v)) * v; }

double to_line(Vec2 p, const Feature& edge) { return std::abs(cross(unit(edge.b - edge.a), p - edge.a)); }

Bisector between_corners(Vec2 one, Vec2 other, Vec2 from, Vec2 to) {
  Bisector made;
  made.kind = Bisector::Kind::corners;
  made.origin = 0.5 * (one + other);
  made.along = unit(perpendicular(other - one));
  made.apart = 0.5 * distance(one, other);
  made.u0 = dot(from - made.origin, made.along);
  made.u1 = dot(to - made.origin, made.along);
  return made;
}

Bisector between_edges(const Feature& edge, Vec2 from, Vec2 to) {
  Bisector made;
  const double length = distance(from, to);
  made.origin = from;
  made.along = length > 0.0 ? unit(to - from) : unit(edge.b - edge.a);
  made.apart = to_line(from, edge);
  made.slope = length > 0.0 ? (to_line(to, edge) - made.apart) / length : 0.0;
  made.u1 = length;
  return made;
}

Bisector parabola(Vec2 corner, const Feature& edge, Vec2 from, Vec2 to) {
  Bisector made;
  made.kind = Bisector::Kind::parabola;
  made.along = unit(edge.b - edge.a);
  made.across = perpendicular(made.along);
  if (dot(corner - edge.a, made.across) < 0.0) made.across = -made.across;
  made.apart = dot(corner - edge.a, made.across);
  made.origin = corner - made.apart * made.across;
  made.u0 = dot(from - made.origin, made.along);
  made.u1 = dot(to - made.origin, made.along);
  return made;
}

}  // namespace

Bisector Bisector::between(const Feature& one, const Feature& other, Vec2 from, Vec2 to) {
  if (one.is_corner() && other.is_corner()) return between_corners(one.a, other.a, from, to);
  if (one.is_corner()) return parabola(one.a, other, from, to);
  if (other.is_corner()) return parabola(other.a, one, from, to);
  return between_edges(one, from, to);
}

Vec2 Bisector::at(double u) const {
  const Vec2 level = origin + u * along;
  return kind == Kind::parabola ? level + clearance(u) * across : level;
}

double Bisector::clearance(double u) const {
  switch (kind) {
    case Kind::edges: return apart + slope * u;
    case Kind::corners: return std::hypot(apart, u);
    case Kind::parabola: return (u * u + apart * apart) / (2.0 * apart);
  }
  return 0.0;
}

double Bisector::least_clearance() const {
  if (kind == Kind::edges) return std::min(clearance(u0), clearance(u1));
  const auto [low, high] = std::minmax(u0, u1);
  return clearance(std::clamp(0.0, low, high));
}

double Bisector::length() const {
  if (kind != Kind::parabola) return std::abs(u1 - u0);
  const auto primitive = [&](double u) {
    const double w = u / apart;
    return 0.5 * apart * (w * std::sqrt(1.0 + w * w) + std::asinh(w));
  };
  return std::abs(primitive(u1) - primitive(u0));
}

double Bisector::exposure() const {
  if (kind != Kind::edges) {
    const double one = std::abs(std::asinh(u1 / apart) - std::asinh(u0 / apart));
    return kind == Kind::corners ? one : 2.0 * one;
  }
  const double from = clearance(u0), rise = clearance(u1) - from;
  if (std::abs(rise) < 1e-9 * from) return length() / from;
  return length() * std::log1p(rise / from) / rise;
}

double Bisector::u_of(Vec2 p) const {
  const auto [low, high] = std::minmax(u0, u1);
  return std::clamp(dot(p - origin, along), low, high);
}

Bisector Bisector::part(double from, double to) const {
  Bisector some = *this;
  some.u0 = from;
  some.u1 = to;
  return some;
}

}  // namespace outrider
