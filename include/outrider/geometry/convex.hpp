// Convex polygons in the plane, and convex polygons grown by a radius.
//
// A RoundedPolygon is a convex core (a point, a segment or a counter-clockwise polygon) plus a disk of
// `radius_m`. It is exactly the area that an upright box, cylinder or sphere covers on the ground, and also
// the area that such an obstacle forbids to the centre of a disk robot. Distances are exact up to rounding.
#pragma once

#include <optional>
#include <vector>

#include "outrider/geometry/box.hpp"
#include "outrider/geometry/vec.hpp"

namespace outrider {

/// Returns the convex hull, counter-clockwise, without collinear points. If all points are equal or on one
/// line, returns one or two points; for no points, returns none. Andrew's monotone chain; O(n log n).
std::vector<Vec2> convex_hull(std::vector<Vec2> points);

/// Returns the part of a convex polygon with dot(normal, p) <= offset (Sutherland-Hodgman, O(n)).
std::vector<Vec2> clip(const std::vector<Vec2>& polygon, Vec2 normal, double offset);

struct Segment {
  Vec2 a;
  Vec2 b;
};

double distance(Vec2 p, Segment s);
/// Returns the distance between two segments; 0 if they touch or cross.
double distance(Segment s, Segment t);

struct RoundedPolygon {
  std::vector<Vec2> core;  ///< convex, counter-clockwise; 1, 2 or more points
  double radius_m = 0.0;

  [[nodiscard]] Box2 bounds() const;
  /// Returns the area of the core grown by the radius, m^2 (Steiner's formula).
  [[nodiscard]] double area() const;
};

/// Returns the distance from p to the shape, m. It is 0 or negative inside; inside the core it is minus the
/// depth in the core minus the radius. O(number of corners).
double signed_distance(Vec2 p, const RoundedPolygon& shape);
/// Returns the distance from a segment to the shape, m; minus the radius if the segment meets the core.
double signed_distance(Segment s, const RoundedPolygon& shape);

/// A closed interval.
struct Interval {
  double low = 0.0;
  double high = 0.0;
};
/// Returns the interval of t in [t_low, t_high] for which origin + t * direction is inside a convex polygon,
/// or nothing if there is none. `direction` need not be a unit vector.
std::optional<Interval> cut(const std::vector<Vec2>& polygon, Vec2 origin, Vec2 direction, double t_low,
                            double t_high);

/// Returns the corners of a polygon that contains the rounded polygon. Each arc is replaced by tangents that
/// turn by at most `step_rad`, so a corner is at most radius / cos(step / 2) away from the core.
std::vector<Vec2> circumscribed(const RoundedPolygon& shape, double step_rad);

/// Returns the corners of a polygon inside the rounded polygon. Each arc is replaced by chords that turn by
/// at most `step_rad`, so its border is at most radius (1 - cos(step / 2)) away from the border of the shape.
std::vector<Vec2> inscribed(const RoundedPolygon& shape, double step_rad);

}  // namespace outrider
