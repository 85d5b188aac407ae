#include "outrider/io/map/world_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <optional>

#include "outrider/io/files/files.hpp"
#include "outrider/io/files/text.hpp"
#include "outrider/io/map/map.hpp"
#include "outrider/io/map/map_server.hpp"
#include "outrider/io/map/slices.hpp"
#include "outrider/io/scenario/values.hpp"
#include "outrider/world/blocks.hpp"
#include "outrider/world/upright.hpp"

namespace outrider {
namespace {

/// Adds a solid. Fault: bad_input with `where` if the world has the maximum number.
Status add_solid(World& world, Solid solid, const std::string& where) {
  constexpr std::size_t most_solids = 200'000;
  if (world.solids.size() >= most_solids) {
    return bad_input(
        fmt::format("the world has more than {} pieces; take a part of it, or larger cells", most_solids),
        where);
  }
  world.solids.push_back(std::move(solid));
  return {};
}

/// Adds slices as solids that stand on the floor.
Status add_slices(World& world, const std::vector<WorldSlice>& slices, double height_m,
                  const std::string& where) {
  for (std::size_t i = 0; i < slices.size(); ++i) {
    const std::string name = fmt::format("{}/{}", slices[i].name.empty() ? "slice" : slices[i].name, i + 1);
    auto ok = add_solid(world, upright(slices[i].corners, name, world.floor_z_m, world.floor_z_m + height_m),
                        where);
    if (!ok) return ok;
  }
  return {};
}

Status add_walls(World& world, const std::string& text, double height_m) {
  std::size_t count = 0;
  for (const std::string_view word : words(text)) {
    auto n = parse_numbers(std::string(word), 4, "walls", "x1,y1,x2,y2 in m, such as 0,0,4,0");
    if (!n) return pass_on(n);
    const std::vector<Vec2> wall = {{(*n)[0], (*n)[1]}, {(*n)[2], (*n)[3]}};
    if (wall[0] == wall[1]) {
      return bad_input(fmt::format("the wall {} has no length; give its two ends", excerpt(word)), "walls");
    }
    auto ok = add_solid(
        world, upright(wall, fmt::format("wall/{}", ++count), world.floor_z_m, world.floor_z_m + height_m),
        "walls");
    if (!ok) return ok;
  }
  return {};
}

Outcome<World> world_of(const MapServerMap& map, const std::string& path, double height_m) {
  if (std::ranges::find(map.occupancy.cells, free_cell) == map.occupancy.cells.end()) {
    return bad_input("the map has no free cell; check its thresholds and whether it is negated", path);
  }
  const Vec2 origin = map.occupancy.frame.origin;
  World world;
  for (Solid& block : blocks(bordered(map.occupancy, unknown_cell), 0.0, height_m)) {
    Vec3& place = block.world_T_solid.position;
    const Vec2 turned = origin + rotated(map.yaw_rad, xy(place) - origin);
    place = {turned.x, turned.y, place.z};
    block.world_T_solid.rotation = Rotation::from_rpy(0.0, 0.0, map.yaw_rad);
    if (auto ok = add_solid(world, std::move(block), path); !ok) return pass_on(ok);
  }
  return world;
}

bool begins_with_a_slice(std::string_view content) {
  TextLines lines{content, {}};
  return lines.next_filled() && trimmed(lines.line).front() != '(' &&
         std::ranges::count(lines.line, ',') >= 3;
}

/// Returns the kind of a map that is a world, too; nothing for slices.
Outcome<std::optional<MapKind>> world_kind(std::string_view content, const std::string& path) {
  for (const std::string& name : {std::string(), path}) {
    const auto kind = map_kind(content, name);
    if (kind && *kind != MapKind::movingai && *kind != MapKind::polygons) return std::optional(*kind);
    if (without_gz(name).ends_with(".csv") || (name.empty() && begins_with_a_slice(content)))
      return std::optional<MapKind>();
  }
  return bad_input(
      "the name does not tell what kind of world it is; worlds end in .sdf, .world, .yaml, .yml, .pgm, .png "
      "or .csv (.gz may follow)",
      path);
}

/// Returns the name of the file without folder and ending.
std::string name_of(const std::string& path) {
  const std::string name = excerpt(std::filesystem::path(path).filename().string());
  return name.substr(0, name.find('.', 1));
}

/// Makes a world from a file that is not SDF, without its floor.
Outcome<World> world_from(std::optional<MapKind> kind, const std::string& content, const std::string& path,
                          const WorldFileOptions& options) {
  if (!kind) {
    auto slices = slices_from_text(content, path);
    if (!slices) return pass_on(slices);
    World world;
    if (auto ok = add_slices(world, *slices, options.wall_height_m, path); !ok) return pass_on(ok);
    return world;
  }
  auto map = kind == MapKind::map_server ? map_server_from_text(content, path)
                                         : map_image_from_bytes(content, path, options.resolution_m);
  if (!map) return pass_on(map);
  return world_of(*map, path, options.wall_height_m);
}

Outcome<LoadedWorld> load_kind(std::optional<MapKind> kind, const std::string& content,
                               const std::string& path, const WorldFileOptions& options) {
  if (kind == MapKind::world) return sdf_from_text(content, path, options.sdf);
  auto world = world_from(kind, content, path, options);
  if (!world) return pass_on(world);
  world->solids.insert(world->solids.begin(), Solid{"floor", {}, HalfSpaceShape{}});
  return LoadedWorld{std::move(*world), {}};
}

}  // namespace

Outcome<LoadedWorld> load_world(const std::string& path, const WorldFileOptions& options) {
  const auto content = read_file(path);
  if (!content) return pass_on(content);
  const auto kind = world_kind(*content, path);
  if (!kind) return pass_on(kind);
  auto loaded = load_kind(*kind, *content, path, options);
  if (!loaded) return loaded;
  World& world = loaded->world;
  if (world.name.empty() || world.name == "default") world.name = name_of(path);
  return loaded;
}

Outcome<LoadedWorld> load_explore_world(const ExploreWorldFiles& files) {
  if (files.world.empty()) return bad_input("missing; give the file of the world to explore", "world");
  auto loaded = load_world(files.world, files.options);
  if (!loaded) return pass_on(loaded);
  World& world = loaded->world;
  if (world.terrain)
    return bad_input("the ground of this world is not flat; give one with a floor", files.world);
  if (!files.slices.empty()) {
    const auto slices = load_slices(files.slices);
    if (!slices) return pass_on(slices);
    if (auto ok = add_slices(world, *slices, files.options.wall_height_m, files.slices); !ok)
      return pass_on(ok);
  }
  if (auto ok = add_walls(world, files.walls, files.options.wall_height_m); !ok) return pass_on(ok);
  const Box2 standing = standing_bounds(world);
  if (!standing.empty()) {
    world.bounds = standing;
  } else if (world.bounds.empty()) {
    return bad_input("nothing stands in this world; there is nothing to explore", files.world);
  }
  return loaded;
}

}  // namespace outrider
