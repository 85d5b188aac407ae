// Region: a part of the plane as polygons with holes, and the algebra of such parts.
//
// Polygons of a region do not overlap; they may touch at corners. Coordinates are rounded to 2^-20 m (about
// a micrometre) within, so a result may be off by so much beside its border; everything within 8000 km of
// the origin is taken. Round corners are chords of the true arcs, nowhere farther from them than `arc_m`.
// Thread rule: pure functions. Complexity: O((n + k) log n) for n edges with k crossings. Source of the
// method: Vatti, A generic solution to polygon clipping, Communications of the ACM 35 (1992) 56-63.
#pragma once

#include <vector>

#include "outrider/geometry/box.hpp"
#include "outrider/geometry/vec.hpp"

namespace outrider {

struct RingedPolygon {
  std::vector<Vec2> outer;               ///< counter-clockwise, m
  std::vector<std::vector<Vec2>> holes;  ///< clockwise, m
};
using Region = std::vector<RingedPolygon>;

/// m2, without the holes.
double area_of(const RingedPolygon& polygon);
double area_of(const Region& region);

Box2 bounds_of(const Region& region);

/// Inside or on the border.
bool contains(const RingedPolygon& polygon, Vec2 p);
bool contains(const Region& region, Vec2 p);
/// To the nearest edge, m.
double distance_to_border(const RingedPolygon& polygon, Vec2 p);

/// The outer polygon without the holes; each of either orientation.
Region region_of(const std::vector<Vec2>& outer, const std::vector<std::vector<Vec2>>& holes);

Region united(const Region& a, const Region& b);
Region common(const Region& a, const Region& b);
Region without(const Region& a, const Region& b);

/// All points within `by_m` of the region (at most: chords lie inside the arcs).
Region grown(const Region& region, double by_m, double arc_m);
/// All points of the region that are `by_m` away from its border (or nearer by at most `arc_m`).
Region shrunk(const Region& region, double by_m, double arc_m);

/// Everything that lies in at least one of the polygons, which may overlap.
Region united(const std::vector<Region>& all);

}  // namespace outrider
