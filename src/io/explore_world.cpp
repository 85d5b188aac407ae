#include "outrider/io/explore_world.hpp"

#include <fmt/format.h>

#include "outrider/io/text.hpp"
#include "outrider/io/values.hpp"
#include "outrider/io/world_file.hpp"
#include "world_pieces.hpp"

namespace outrider {
namespace {

Status add_walls(World& world, const std::string& text, double height_m) {
  std::size_t count = 0;
  for (const std::string_view word : words(text)) {
    auto n = parse_numbers(std::string(word), 4, "walls", "x1,y1,x2,y2 in m, such as 0,0,4,0");
    if (!n) return pass_on(n);
    const WorldSlice wall{"", {{(*n)[0], (*n)[1]}, {(*n)[2], (*n)[3]}}};
    if (wall.corners[0] == wall.corners[1]) {
      return bad_input(fmt::format("the wall {} has no length; give its two ends", excerpt(word)), "walls");
    }
    auto ok = add_solid(
        world, upright(wall, fmt::format("wall/{}", ++count), world.floor_z_m, world.floor_z_m + height_m),
        "walls");
    if (!ok) return ok;
  }
  return {};
}

}  // namespace

Outcome<LoadedWorld> load_explore_world(const ExploreWorldFiles& files) {
  if (files.world.empty()) return bad_input("missing; give the file of the world to explore", "world");
  auto loaded = load_world(files.world, {files.resolution_m, files.wall_height_m, files.sdf});
  if (!loaded) return pass_on(loaded);
  World& world = loaded->world;
  if (world.terrain)
    return bad_input("the ground of this world is not flat; give one with a floor", files.world);
  if (!files.slices.empty()) {
    const auto slices = load_slices(files.slices);
    if (!slices) return pass_on(slices);
    if (auto ok = add_slices(world, *slices, files.wall_height_m, files.slices); !ok) return pass_on(ok);
  }
  if (auto ok = add_walls(world, files.walls, files.wall_height_m); !ok) return pass_on(ok);
  const Box2 standing = standing_bounds(world);
  if (!standing.empty()) {
    world.bounds = standing;
  } else if (world.bounds.empty()) {
    return bad_input("nothing stands in this world; there is nothing to explore", files.world);
  }
  return loaded;
}

}  // namespace outrider
