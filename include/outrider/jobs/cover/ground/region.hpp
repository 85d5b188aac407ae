// Region: a part of the plane as polygons with holes, and boolean operations on such parts.
//
// The polygons of a region do not overlap; they may touch at corners. Coordinates are rounded to 2^-20 m
// (about a micrometre), so the border of a result may be off by that much. Coordinates must lie within 8000
// km of the origin. Round corners are chords of the true arcs, at most `arc_m` away from them. Thread rule:
// pure functions. Complexity: O((n + k) log n) for n edges with k crossings. Source of the method: Vatti, A
// generic solution to polygon clipping, Communications of the ACM 35 (1992) 56-63.
#pragma once

#include <vector>

#include "outrider/geometry/box.hpp"
#include "outrider/geometry/convex.hpp"
#include "outrider/geometry/vec.hpp"

namespace outrider {

struct RingedPolygon {
  std::vector<Vec2> outer;               ///< counter-clockwise, m
  std::vector<std::vector<Vec2>> holes;  ///< clockwise, m
};
using Region = std::vector<RingedPolygon>;

/// Returns the area without the holes, m2.
double area_of(const RingedPolygon& polygon);
double area_of(const Region& region);

/// Returns the centroid of the outer polygon; it may lie outside of a bent one.
Vec2 middle_of(const RingedPolygon& polygon);

/// Returns the smallest box that contains the region.
Box2 bounds_of(const Region& region);

/// Returns true if the point is inside or on the border.
bool contains(const RingedPolygon& polygon, Vec2 p);
bool contains(const Region& region, Vec2 p);
/// Returns the distance to the nearest edge, m.
double distance_to_border(const RingedPolygon& polygon, Vec2 p);

/// Returns the outer polygon without the holes. Each may have either orientation.
Region region_of(const std::vector<Vec2>& outer, const std::vector<std::vector<Vec2>>& holes);

/// Returns the union.
Region united(const Region& a, const Region& b);
/// Returns the intersection.
Region common(const Region& a, const Region& b);
/// Returns the difference a - b.
Region without(const Region& a, const Region& b);

/// Returns the points within `by_m` of the region, without slivers near arcs: chords lie inside the arcs.
Region grown(const Region& region, double by_m, double arc_m);
/// Returns the points of the region that are at least `by_m` away from its border (or nearer by at most
/// `arc_m`).
Region shrunk(const Region& region, double by_m, double arc_m);
/// Returns the part of the region that is wider than twice `by_m`.
Region opened(const Region& region, double by_m, double arc_m);

/// Returns the edges of all rings, with the region on their left.
std::vector<Segment> edges_of(const Region& region);

/// Returns the union of all regions, which may overlap.
Region united(const std::vector<Region>& all);

}  // namespace outrider
