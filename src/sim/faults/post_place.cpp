#include "outrider/sim/faults/post_place.hpp"

#include <fmt/format.h>

#include "outrider/core/text.hpp"
#include "outrider/world/collision_map.hpp"
#include "times.hpp"

namespace outrider {
namespace {

constexpr const char* key = "faults.blocked_place";
constexpr double post_height_m = 1.0;
constexpr double low_m = 0.1;  ///< what is lower lies on the floor

}  // namespace

Status check_post_place(const World& world, Vec2 place, double blocked_at_s) {
  const std::string text = fmt::format("{:g},{:g}", place.x, place.y);
  if (blocked_at_s >= never_s) {
    return bad_input(
        fmt::format("a post is put at {} at no time; give faults.blocked_at, or leave this out", text), key);
  }
  const Box2& bounds = world.bounds;
  if (!bounds.contains(place)) {
    return bad_input(
        fmt::format("{} is outside the map, which lies between {} and {}; put the post in there", text,
                    place_text(bounds.low.x, bounds.low.y), place_text(bounds.high.x, bounds.high.y)),
        key);
  }
  const CollisionMap ground = CollisionMap::of(world, post_height_m, low_m);
  for (const RoundedPolygon& piece : ground.obstacles()) {
    if (signed_distance(place, piece) > 0.0) continue;
    return bad_input(fmt::format("{} lies within what stands there; put the post on free ground, such as the "
                                 "middle of a doorway",
                                 text),
                     key);
  }
  return {};
}

}  // namespace outrider
