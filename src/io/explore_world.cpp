#include "outrider/io/explore_world.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "outrider/io/map_server.hpp"
#include "outrider/io/slices.hpp"
#include "outrider/io/text.hpp"
#include "outrider/io/values.hpp"
#include "outrider/world/blocks.hpp"

namespace outrider {
namespace {

constexpr std::size_t most_solids = 200'000;

Status add(World& world, Solid solid, const std::string& where) {
  if (world.solids.size() >= most_solids) {
    return bad_input(
        fmt::format("the world has more than {} pieces; take a part of it, or larger cells", most_solids),
        where);
  }
  world.solids.push_back(std::move(solid));
  return {};
}

Status add_slices(World& world, const std::string& path, double height_m) {
  auto slices = load_slices(path);
  if (!slices) return pass_on(slices);
  for (std::size_t i = 0; i < slices->size(); ++i) {
    const WorldSlice& slice = (*slices)[i];
    const std::string name = fmt::format("{}/{}", slice.name.empty() ? "slice" : slice.name, i + 1);
    auto ok = add(world, upright(slice, name, world.floor_z_m, world.floor_z_m + height_m), path);
    if (!ok) return ok;
  }
  return {};
}

Status add_walls(World& world, const std::string& text, double height_m) {
  std::size_t count = 0;
  for (const std::string_view word : words(text)) {
    auto n = parse_numbers(std::string(word), 4, "walls", "x1,y1,x2,y2 in m, such as 0,0,4,0");
    if (!n) return pass_on(n);
    const WorldSlice wall{"", {{(*n)[0], (*n)[1]}, {(*n)[2], (*n)[3]}}};
    if (wall.corners[0] == wall.corners[1]) {
      return bad_input(fmt::format("the wall {} has no length; give its two ends", excerpt(word)), "walls");
    }
    auto ok = add(world,
                  upright(wall, fmt::format("wall/{}", ++count), world.floor_z_m, world.floor_z_m + height_m),
                  "walls");
    if (!ok) return ok;
  }
  return {};
}

/// The map with a ring of unknown cells around it.
Grid<std::uint8_t> ringed(const Grid<std::uint8_t>& occupancy) {
  GridFrame frame = occupancy.frame;
  frame.origin = frame.corner({-1, -1});
  frame.width += 2;
  frame.height += 2;
  Grid<std::uint8_t> ringed(frame, unknown_cell);
  for (std::size_t i = 0; i < occupancy.cells.size(); ++i) {
    const Cell c = occupancy.frame.cell(i);
    ringed[{c.x + 1, c.y + 1}] = occupancy.cells[i];
  }
  return ringed;
}

Outcome<World> world_of(const MapServerMap& map, const std::string& path, double height_m) {
  if (std::ranges::find(map.occupancy.cells, free_cell) == map.occupancy.cells.end()) {
    return bad_input("the map has no free cell; check its thresholds and whether it is negated", path);
  }
  const Vec2 origin = map.occupancy.frame.origin;
  const Vec2 along = direction(map.yaw_rad);
  World world;
  for (Solid& block : blocks(ringed(map.occupancy), 0.0, height_m)) {
    Vec3& place = block.world_T_solid.position;
    const Vec2 from_origin = xy(place) - origin;
    const Vec2 turned = origin + from_origin.x * along + from_origin.y * perpendicular(along);
    place = {turned.x, turned.y, place.z};
    block.world_T_solid.rotation = Rotation::from_rpy(0.0, 0.0, map.yaw_rad);
    if (auto ok = add(world, std::move(block), path); !ok) return pass_on(ok);
  }
  return world;
}

Outcome<World> from_image(const std::string& path, const ExploreWorldFiles& files, bool with_yaml) {
  auto map = with_yaml ? load_map_server(path) : load_map_image(path, files.resolution_m);
  if (!map) return pass_on(map);
  return world_of(*map, path, files.wall_height_m);
}

/// The name of the file without its folder and ending.
std::string name_of(const std::string& path) {
  const std::string name = excerpt(std::filesystem::path(path).filename().string());
  return name.substr(0, name.find('.', 1));
}

Outcome<LoadedWorld> load_by_name(const ExploreWorldFiles& files) {
  std::string stem = files.world;
  if (stem.ends_with(".gz")) stem.resize(stem.size() - 3);
  if (stem.ends_with(".sdf") || stem.ends_with(".world")) return load_sdf(files.world);
  LoadedWorld loaded;
  const bool yaml = stem.ends_with(".yaml") || stem.ends_with(".yml");
  if (yaml || stem.ends_with(".pgm") || stem.ends_with(".png")) {
    auto world = from_image(files.world, files, yaml);
    if (!world) return pass_on(world);
    loaded.world = std::move(*world);
  } else if (stem.ends_with(".csv")) {
    if (auto ok = add_slices(loaded.world, files.world, files.wall_height_m); !ok) return pass_on(ok);
  } else {
    return bad_input(
        "the name does not tell what kind of world it is; worlds end in .sdf, .world, .yaml, .yml, .pgm, "
        ".png "
        "or .csv (.gz may follow)",
        files.world);
  }
  loaded.world.solids.insert(loaded.world.solids.begin(), Solid{"floor", {}, HalfSpaceShape{}});
  return loaded;
}

}  // namespace

Outcome<LoadedWorld> load_explore_world(const ExploreWorldFiles& files) {
  if (files.world.empty()) return bad_input("missing; give the file of the world to explore", "world");
  auto loaded = load_by_name(files);
  if (!loaded) return pass_on(loaded);
  World& world = loaded->world;
  if (world.terrain)
    return bad_input("the ground of this world is not flat; give one with a floor", files.world);
  if (world.name.empty() || world.name == "default") world.name = name_of(files.world);
  if (!files.slices.empty()) {
    if (auto ok = add_slices(world, files.slices, files.wall_height_m); !ok) return pass_on(ok);
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
