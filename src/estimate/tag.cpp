#include "outrider/estimate/tag.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace outrider {

const Tag* TagMap::find(int id) const {
  const auto found = std::ranges::find(tags, id, &Tag::id);
  return found == tags.end() ? nullptr : &*found;
}

Status check_tags(const TagMap& map) {
  for (const Tag& tag : map.tags) {
    if (auto ok = check_tag_id(tag.id, map.family); !ok) return ok;
    if (map.find(tag.id) != &tag) {
      return bad_input(fmt::format("the tag {} hangs twice; give one of them another id", tag.id));
    }
    if (!(tag.size_m > 0.0) || !std::isfinite(tag.size_m)) {
      return bad_input(
          fmt::format("the tag {} has a side of {:g} m; it must be above 0", tag.id, tag.size_m));
    }
  }
  return {};
}

Tag upright_tag(int id, Vec3 position, double facing_rad, double size_m) {
  const Vec2 facing = direction(facing_rad);
  const Vec2 right = perpendicular(facing);  // right side for the reader, who looks against `facing`
  return {
      id, size_m, {position, {{Vec3{right.x, right.y, 0}, Vec3{0, 0, -1}, Vec3{-facing.x, -facing.y, 0}}}}};
}

std::array<Vec3, 4> tag_corners(double size_m) {
  const double h = 0.5 * size_m;
  return {Vec3{-h, h, 0}, Vec3{h, h, 0}, Vec3{h, -h, 0}, Vec3{-h, -h, 0}};
}

}  // namespace outrider
