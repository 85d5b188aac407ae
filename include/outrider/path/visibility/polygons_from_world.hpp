// Makes polygons for a disk robot from the exact shapes of a world.
//
// The boundary is that of the world's bounds. Obstacles with sharp corners are used unchanged. A round
// obstacle (cylinder, sphere, capsule) becomes a circumscribed polygon whose sides are tangents that turn by
// at most 10 degrees. The polygon contains the obstacle and exceeds it by at most radius (1 / cos(5 degrees)
// - 1), 0.4 % of the radius. So every path among the polygons is collision-free in the world; only gaps that
// the disk fits through by less than that are lost. O(corners^2), as for PolygonGround::of(). Faults: those
// of PolygonGround::of().
#pragma once

#include "outrider/path/visibility/polygon_ground.hpp"
#include "outrider/world/collision_map.hpp"

namespace outrider {

/// Returns the obstacle as a polygon, as described above.
std::vector<Vec2> outline(const RoundedPolygon& obstacle);

/// Returns the ground of a world for a disk of that radius.
Outcome<PolygonGround> polygons_from_world(const CollisionMap& ground, double radius_m);

}  // namespace outrider
