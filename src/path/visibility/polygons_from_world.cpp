#include "outrider/path/visibility/polygons_from_world.hpp"

#include "outrider/core/units.hpp"

namespace outrider {

std::vector<Vec2> outline(const RoundedPolygon& obstacle) {
  return obstacle.radius_m == 0.0 ? obstacle.core : circumscribed(obstacle, radians(10.0));
}

Outcome<PolygonGround> polygons_from_world(const CollisionMap& ground, double radius_m) {
  const Box2& bounds = ground.bounds();
  std::vector<std::vector<Vec2>> obstacles;
  for (const RoundedPolygon& obstacle : ground.obstacles()) obstacles.push_back(outline(obstacle));
  return PolygonGround::of(
      {bounds.low, {bounds.high.x, bounds.low.y}, bounds.high, {bounds.low.x, bounds.high.y}},
      std::move(obstacles), radius_m);
}

}  // namespace outrider
