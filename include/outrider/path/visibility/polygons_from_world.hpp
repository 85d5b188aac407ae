// Polygons from the exact shapes of a world, for a disk robot.
//
// The boundary is that of the world's bounds. An obstacle with sharp corners is taken as it is; one that is
// round (a cylinder, a sphere, a capsule) as the tangents that turn by at most 10 degrees about it, which
// hold it and stand out by at most its radius (1 / cos(5 degrees) - 1), 0.4 % of it. So every path among
// the polygons is free of collision in the world, and what is lost is a gap that the disk fits through by
// less than that. O(corners^2), as PolygonGround::of(). Faults: those of PolygonGround::of().
#pragma once

#include "outrider/path/visibility/polygon_ground.hpp"
#include "outrider/world/collision_map.hpp"

namespace outrider {

/// The obstacle as a polygon, as above.
std::vector<Vec2> outline(const RoundedPolygon& obstacle);

Outcome<PolygonGround> polygons_from_world(const CollisionMap& ground, double radius_m);

}  // namespace outrider
