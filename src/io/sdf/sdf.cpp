#include "outrider/io/sdf/sdf.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <memory>
#include <set>

#include "files/open_file.hpp"
#include "outrider/io/files/files.hpp"
#include "outrider/io/files/text.hpp"
#include "sdf/sdf_floor.hpp"
#include "sdf/sdf_scene.hpp"
#include "sdf/sdf_shapes.hpp"

namespace outrider {
namespace {

constexpr double farthest_m = 1e6;
constexpr std::size_t most_world_solids = 200'000;
constexpr std::size_t largest_world_bytes = std::size_t{64} << 20;

bool is_place(Vec3 p) {  // false for NaN too
  return std::abs(p.x) <= farthest_m && std::abs(p.y) <= farthest_m && std::abs(p.z) <= farthest_m;
}

bool is_size(double size_m) { return size_m > 0.0 && size_m <= farthest_m; }

/// Returns the names "model/link/collision". A link or a collision that is the only one is omitted, and a
/// collision does not repeat the name of its link.
std::vector<std::string> solid_names(const SdfScene& scene) {
  const auto model_of = [&](std::size_t link) -> const std::string& {
    return scene.scopes[scene.frames[link].scope].name;
  };
  std::map<std::string_view, std::set<std::size_t>> links;  // by model
  std::map<std::size_t, std::size_t> siblings;              // by link
  for (const SdfCollision& one : scene.collisions) {
    links[model_of(one.link)].insert(one.link);
    ++siblings[one.link];
  }
  std::vector<std::string> names;
  for (const SdfCollision& one : scene.collisions) {
    const std::string& link = scene.frames[one.link].name;
    std::string name = model_of(one.link);
    if (links[name].size() > 1) name += '/' + link;
    if (siblings[one.link] > 1) {
      std::string last = one.name;
      const std::string prefix = link + '_';
      if (last.starts_with(prefix) && last.size() > prefix.size()) last.erase(0, prefix.size());
      name.append(1, '/').append(last);
    }
    names.push_back(is_printable(name) ? name : excerpt(name, name.size()));
  }
  return names;
}

/// The world that is built from a scene, and its sources.
struct Building {
  SdfFiles& files;
  const std::string& name;
  World world;
  std::vector<FloorPlane> floors;
  SdfMeshes meshes;
  UniqueNames taken;
};

tl::unexpected<Fault> bad_collision(const Building& building, const std::string& name, const Fault& fault) {
  const std::string& where = fault.where;
  return bad_input(
      fmt::format("collision '{}': {}{}", name, where.empty() ? where : where + ": ", fault.sentence),
      building.name);
}

Status add_terrain(Building& building, const SdfCollision& collision, const std::string& name,
                   const Pose3& world_T_collision) {
  if (building.world.terrain)
    return bad_collision(building, name, {FaultCode::bad_input, "a world has one heightmap; leave one", ""});
  auto field = sdf_terrain(*collision.file, collision.shape, collision.mesh, world_T_collision);
  if (!field) return bad_collision(building, name, field.error());
  building.world.terrain = std::make_shared<const HeightField>(std::move(*field));
  return {};
}

Status add_solids_of(Building& building, const SdfCollision& collision, const std::string& name,
                     const Pose3& world_T_collision) {
  auto pieces = sdf_pieces(building.files, *collision.file, collision.shape, collision.mesh, building.meshes);
  if (!pieces) return bad_collision(building, name, pieces.error());
  for (SdfPiece& piece : *pieces) {
    Solid solid{building.taken.take(name + piece.suffix), world_T_collision * piece.collision_T_piece,
                std::move(piece.shape)};
    if (!is_place(solid.world_T_solid.position)) {
      return bad_input(
          fmt::format("collision '{}' stands beyond 1e6 m, or nowhere; correct its <pose>", name),
          building.name);
    }
    const bool level = solid.world_T_solid.rotation.axes[2].z > 1.0 - 1e-9;
    if (level && std::holds_alternative<HalfSpaceShape>(solid.shape)) {
      const Vec3 size = SdfNumbers(*collision.file).of(collision.shape, "size", 2, {1, 1, 0});
      const bool known = is_size(size.x) && is_size(size.y);
      building.floors.push_back({solid.world_T_solid.position, known ? xy(size) : Vec2{}});
    }
    building.world.solids.push_back(std::move(solid));
    if (building.world.solids.size() > most_world_solids) {
      return bad_input(
          fmt::format("the world has more than {} collisions, the most that is read", most_world_solids),
          building.name);
    }
  }
  return {};
}

Status set_gravity(World& world, Vec3 g, const std::string& file) {
  if (!is_place(g) || norm(xy(g)) > 1e-9 * std::abs(g.z) || g.z >= 0.0) {
    return bad_input(
        fmt::format("gravity {} {} {} does not point straight down; write e.g. <gravity>0 0 -9.8</gravity>",
                    short_number(g.x), short_number(g.y), short_number(g.z)),
        file);
  }
  world.gravity_mps2 = -g.z;
  return {};
}

/// Makes the world of a scene.
Outcome<World> build(SdfFiles& files, const SdfScene& scene, const std::string& name) {
  if (scene.collisions.empty())
    return bad_input("nothing in it has a collision; there is no world to plan in", name);
  Building building{files, name, {}, {}, {}, {}};
  building.world.name = excerpt(scene.name);
  if (auto gravity = set_gravity(building.world, scene.gravity, name); !gravity) return pass_on(gravity);
  auto poses = collision_poses(scene);
  if (!poses) return pass_on(poses);
  const std::vector<std::string> names = solid_names(scene);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const SdfCollision& collision = scene.collisions[i];
    const bool is_terrain = one_of(collision.shape.name(), {"heightmap"});
    auto added = (is_terrain ? add_terrain : add_solids_of)(building, collision, names[i], (*poses)[i]);
    if (!added) return pass_on(added);
  }
  World world = std::move(building.world);
  if (const auto terrain = std::exchange(world.terrain, nullptr)) world = world.on(terrain);
  if (scene.bare && building.floors.empty()) {
    world.solids.insert(world.solids.begin(), Solid{"floor", {}, HalfSpaceShape{}});
    building.floors.push_back({});
  }
  if (auto floor = set_floor_and_bounds(world, building.floors, name); !floor) return pass_on(floor);
  return world;
}

Status check_folders(const std::string& model_path) {
  for (const std::string_view folder : filled_parts_between(model_path, ':')) {
    if (file_kind(std::string(folder)) != FileKind::folder)
      return bad_input(fmt::format("there is no folder '{}'; give one with models", excerpt(folder, 200)),
                       "model_path");
  }
  return {};
}

/// Returns the fault with the first file that the world names and that was not found: it may be the cause.
tl::unexpected<Fault> refused(const Fault& cause, const SdfWarnings& warnings) {
  const std::string& missing = warnings.first_missing();
  return fault(cause.code, missing.empty() ? cause.sentence : cause.sentence + "; " + missing, cause.where);
}

}  // namespace

std::vector<Option> describe(SdfOptions& options) {
  return {file_option("model_path",
                      "folder with the models that an SDF world names; more in GZ_SIM_RESOURCE_PATH and "
                      "GAZEBO_MODEL_PATH, separated by ':'",
                      &options.model_path)};
}

Outcome<LoadedWorld> sdf_from_text(std::string_view text, const std::string& name,
                                   const SdfOptions& options) {
  if (auto ok = check_folders(options.model_path); !ok) return pass_on(ok);
  SdfFiles files(options.model_path);
  auto file = files.parse(text, name);
  if (!file) return pass_on(file);
  const XmlElement root = (*file)->document.root();
  if (!root.child("world")) {
    files.warnings.add((*file)->document.where(root),
                       "there is no <world>; its models were put into one, on a floor at z = 0");
  }
  auto scene = scan_sdf(files, **file);
  if (!scene) return pass_on(scene);
  auto world = build(files, *scene, name);
  if (!world) return refused(world.error(), files.warnings);
  return LoadedWorld{std::move(*world), files.warnings.sentences()};
}

Outcome<LoadedWorld> load_sdf(const std::string& path, const SdfOptions& options) {
  auto text = read_file(path, largest_world_bytes);
  if (!text) return pass_on(text);
  return sdf_from_text(*text, path, options);
}

}  // namespace outrider
