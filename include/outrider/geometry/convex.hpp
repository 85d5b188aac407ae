// Convex polygons of the plane, and the same grown by a radius.
//
// A RoundedPolygon is a convex core (a point, a segment or a counter-clockwise polygon) plus a disk
// of `radius_m`: exactly what an upright box, cylinder or sphere covers on the ground, and what such
// an obstacle forbids to the centre of a disk robot. Distances are exact up to rounding.
#pragma once

#include <optional>
#include <vector>

#include "outrider/geometry/box.hpp"
#include "outrider/geometry/vec.hpp"

namespace outrider {

/// Convex hull, counter-clockwise, without collinear points (Andrew's monotone chain, O(n log n)).
/// One or two points come back for degenerate input, none for none.
std::vector<Vec2> convex_hull(std::vector<Vec2> points);

/// The part of a convex polygon where dot(normal, p) <= offset (Sutherland-Hodgman, O(n)).
std::vector<Vec2> clip(const std::vector<Vec2>& polygon, Vec2 normal, double offset);

struct Segment {
  Vec2 a;
  Vec2 b;
};

double distance(Vec2 p, Segment s);
/// Zero when the segments touch or cross.
double distance(Segment s, Segment t);

struct RoundedPolygon {
  std::vector<Vec2> core;  ///< convex, counter-clockwise; 1, 2 or more points
  double radius_m = 0.0;

  [[nodiscard]] Box2 bounds() const;
  /// Area of the core grown by the radius, m^2 (Steiner's formula).
  [[nodiscard]] double area() const;
};

/// Distance from p to the shape, m; 0 or negative inside (minus the depth in the core, minus the
/// radius). O(number of corners).
double signed_distance(Vec2 p, const RoundedPolygon& shape);
/// Distance from a segment to the shape, m; when the segment meets the core, minus the radius.
double signed_distance(Segment s, const RoundedPolygon& shape);

/// The part of the ray origin + t * direction inside a convex polygon, as [t_in, t_out] clipped to
/// [t_low, t_high]; nothing when they do not meet. `direction` need not be a unit vector.
struct Interval {
  double low = 0.0;
  double high = 0.0;
};
std::optional<Interval> cut(const std::vector<Vec2>& polygon, Vec2 origin, Vec2 direction, double t_low,
                            double t_high);

/// Corners of a polygon that contains the rounded polygon: each arc is replaced by tangents that
/// turn by at most `step_rad`, so a corner lies at most radius / cos(step / 2) from the core.
std::vector<Vec2> circumscribed(const RoundedPolygon& shape, double step_rad);

/// Corners of a polygon inside the rounded polygon: each arc is replaced by chords that turn by at most
/// `step_rad`, so no point of it is farther than radius (1 - cos(step / 2)) from the border of the shape.
std::vector<Vec2> inscribed(const RoundedPolygon& shape, double step_rad);

}  // namespace outrider
