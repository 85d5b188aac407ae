#include "outrider/geometry/convex.hpp"

#include <algorithm>
#include <limits>

#include "outrider/core/units.hpp"

namespace outrider {
namespace {

/// Calls visit(a, b) for each edge of the core; a point is an edge from itself to itself.
template <class Visit>
void for_each_edge(const std::vector<Vec2>& core, Visit visit) {
  const std::size_t n = core.size();
  const std::size_t edges = n <= 2 ? std::min<std::size_t>(n, 1) : n;
  for (std::size_t i = 0; i < edges; ++i) visit(core[i], core[(i + 1) % n]);
}

/// Returns the largest signed distance from p to the line of an edge; negative inside.
double largest_edge_offset(Vec2 p, const std::vector<Vec2>& core) {
  double largest = -std::numeric_limits<double>::infinity();
  for_each_edge(core, [&](Vec2 a, Vec2 b) {
    const Vec2 edge = b - a;
    largest = std::max(largest, cross(p - a, edge) / norm(edge));
  });
  return largest;
}

}  // namespace

std::vector<Vec2> convex_hull(std::vector<Vec2> points) {
  const auto before = [](Vec2 a, Vec2 b) { return a.x != b.x ? a.x < b.x : a.y < b.y; };
  std::sort(points.begin(), points.end(), before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;

  std::vector<Vec2> hull;
  const auto extend = [&hull](Vec2 p, std::size_t floor) {
    while (hull.size() >= floor + 2 && cross(hull.back() - hull[hull.size() - 2], p - hull.back()) <= 0.0) {
      hull.pop_back();
    }
    hull.push_back(p);
  };
  for (const Vec2 p : points) extend(p, 0);
  const std::size_t lower = hull.size() - 1;
  for (auto it = points.rbegin() + 1; it != points.rend(); ++it) extend(*it, lower);
  hull.pop_back();
  return hull;
}

std::vector<Vec2> clip(const std::vector<Vec2>& polygon, Vec2 normal, double offset) {
  std::vector<Vec2> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i];
    const Vec2 b = polygon[(i + 1) % polygon.size()];
    const double da = dot(normal, a) - offset;
    const double db = dot(normal, b) - offset;
    if (da <= 0.0) kept.push_back(a);
    if ((da < 0.0 && db > 0.0) || (da > 0.0 && db < 0.0)) kept.push_back(a + da / (da - db) * (b - a));
  }
  return kept;
}

double distance(Vec2 p, Segment s) {
  const Vec2 along = s.b - s.a;
  const double length2 = squared_norm(along);
  const double t = length2 > 0.0 ? std::clamp(dot(p - s.a, along) / length2, 0.0, 1.0) : 0.0;
  return distance(p, s.a + t * along);
}

double distance(Segment s, Segment t) {
  const Vec2 ds = s.b - s.a;
  const Vec2 dt = t.b - t.a;
  const bool s_splits_t = cross(ds, t.a - s.a) * cross(ds, t.b - s.a) < 0.0;
  const bool t_splits_s = cross(dt, s.a - t.a) * cross(dt, s.b - t.a) < 0.0;
  if (s_splits_t && t_splits_s) return 0.0;
  return std::min({distance(s.a, t), distance(s.b, t), distance(t.a, s), distance(t.b, s)});
}

Box2 RoundedPolygon::bounds() const {
  Box2 box;
  for (const Vec2 p : core) box.include(p);
  return box.grown(radius_m);
}

double RoundedPolygon::area() const {
  double twice_core = 0.0;
  double perimeter = 0.0;
  for (std::size_t i = 0; i < core.size(); ++i) {
    const Vec2 a = core[i];
    const Vec2 b = core[(i + 1) % core.size()];
    twice_core += cross(a, b);
    perimeter += distance(a, b);
  }
  return 0.5 * twice_core + perimeter * radius_m + pi * radius_m * radius_m;
}

double signed_distance(Vec2 p, const RoundedPolygon& shape) {
  if (shape.core.size() >= 3) {
    const double depth = largest_edge_offset(p, shape.core);
    if (depth <= 0.0) return depth - shape.radius_m;
  }
  double nearest = std::numeric_limits<double>::infinity();
  for_each_edge(shape.core, [&](Vec2 a, Vec2 b) { nearest = std::min(nearest, distance(p, {a, b})); });
  return nearest - shape.radius_m;
}

double signed_distance(Segment s, const RoundedPolygon& shape) {
  if (shape.core.size() >= 3 && largest_edge_offset(s.a, shape.core) <= 0.0) return -shape.radius_m;
  double nearest = std::numeric_limits<double>::infinity();
  for_each_edge(shape.core, [&](Vec2 a, Vec2 b) { nearest = std::min(nearest, distance(s, Segment{a, b})); });
  return nearest - shape.radius_m;
}

std::optional<Interval> cut(const std::vector<Vec2>& polygon, Vec2 origin, Vec2 direction, double t_low,
                            double t_high) {
  for (std::size_t i = 0, before = polygon.size() - 1; i < polygon.size(); before = i++) {
    const Vec2 a = polygon[before];
    const Vec2 edge = polygon[i] - a;
    const double outside = cross(origin - a, edge);  // positive on the outer side
    const double rate = cross(direction, edge);
    if (rate == 0.0) {
      if (outside > 0.0) return std::nullopt;
    } else if (rate < 0.0) {
      t_low = std::max(t_low, -outside / rate);
    } else {
      t_high = std::min(t_high, -outside / rate);
    }
  }
  if (t_low > t_high) return std::nullopt;
  return Interval{t_low, t_high};
}

namespace {

/// Calls visit(corner, from, pieces, half) for the arc of the border at each corner of the core. The arc is
/// divided into equal pieces of at most `step_rad`; `from` is the direction of the outward normal at the
/// beginning of the first piece, and `half` is half the angle of a piece.
template <class Visit>
void for_each_arc(const RoundedPolygon& shape, double step_rad, Visit visit) {
  constexpr double slack = 1e-9;  // for rounding errors: a right angle is one step of 90 degrees
  const std::size_t n = shape.core.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 corner = shape.core[i];
    // The directions of the two edges at this corner limit the arc of outward normals.
    const double from = n == 1 ? 0.0 : heading_of(corner - shape.core[(i + n - 1) % n]) - pi / 2;
    const double to = n == 1 ? 2.0 * pi : heading_of(shape.core[(i + 1) % n] - corner) - pi / 2;
    double sweep = n == 1 ? 2.0 * pi : wrap_angle(to - from);
    if (sweep < -slack) sweep += 2.0 * pi;
    const int pieces = std::max(1, static_cast<int>(std::ceil(sweep / step_rad - slack)));
    visit(corner, from, pieces, 0.5 * sweep / pieces);
  }
}

}  // namespace

std::vector<Vec2> circumscribed(const RoundedPolygon& shape, double step_rad) {
  std::vector<Vec2> corners;
  for_each_arc(shape, step_rad, [&](Vec2 corner, double from, int pieces, double half) {
    for (int k = 0; k < pieces; ++k) {
      corners.push_back(corner + shape.radius_m / std::cos(half) * direction(from + (2 * k + 1) * half));
    }
  });
  return corners;
}

std::vector<Vec2> inscribed(const RoundedPolygon& shape, double step_rad) {
  if (shape.radius_m == 0.0) return shape.core;
  const bool closed = shape.core.size() == 1;  // the last point of a circle is the first
  std::vector<Vec2> corners;
  for_each_arc(shape, step_rad, [&](Vec2 corner, double from, int pieces, double half) {
    for (int k = 0; k < pieces + (closed ? 0 : 1); ++k) {
      corners.push_back(corner + shape.radius_m * direction(from + 2 * k * half));
    }
  });
  return corners;
}

}  // namespace outrider
