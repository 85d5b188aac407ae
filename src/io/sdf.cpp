#include "outrider/io/sdf.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>
#include <memory>
#include <sdf/Collision.hh>
#include <sdf/Heightmap.hh>
#include <sdf/Link.hh>
#include <sdf/Model.hh>
#include <sdf/Plane.hh>
#include <sdf/World.hh>
#include <set>

#include "open_file.hpp"
#include "outrider/io/files.hpp"
#include "outrider/io/text.hpp"
#include "sdf_files.hpp"
#include "sdf_floor.hpp"
#include "sdf_parse.hpp"
#include "sdf_repair.hpp"
#include "sdf_shapes.hpp"
#include "unique_names.hpp"

namespace outrider {
namespace {

constexpr double farthest_m = 1e6;
constexpr std::size_t most_solids = 200'000;
constexpr std::size_t largest_world_bytes = std::size_t{64} << 20;

Vec3 vec(const ignition::math::Vector3d& v) { return {v.X(), v.Y(), v.Z()}; }

Pose3 pose(const ignition::math::Pose3d& p) {
  return {vec(p.Pos()), {{vec(p.Rot().XAxis()), vec(p.Rot().YAxis()), vec(p.Rot().ZAxis())}}};
}

bool is_place(Vec3 p) {  // false for NaN too
  return std::abs(p.x) <= farthest_m && std::abs(p.y) <= farthest_m && std::abs(p.z) <= farthest_m;
}

bool is_size(double size_m) { return size_m > 0.0 && size_m <= farthest_m; }

// ---- Poses and names -----------------------------------------------------------------------------

/// A collision found in the tree of models.
struct Found {
  std::string model;  ///< with the names of the enclosing models, separated by '/'
  const sdf::Link* link = nullptr;
  const sdf::Collision* collision = nullptr;
  Pose3 world_T_collision;
};

struct Walk {
  const std::map<std::string, Pose3>& stated;
  const std::string& file;
  std::vector<Found> found;

  /// Returns the world pose of a part: that of the saved state, or else the one from its parent.
  Outcome<Pose3> place(const sdf::SemanticPose& part, const std::string& resolve_to,
                       const Pose3& world_T_parent, const std::string& key) const {
    if (const auto known = stated.find(key); known != stated.end()) return known->second;
    ignition::math::Pose3d parent_T_part;
    if (const auto errors = part.Resolve(parent_T_part, resolve_to); !errors.empty()) {
      return bad_input(fmt::format("the pose of '{}' hangs in the air: {}", excerpt(key),
                                   excerpt(errors.front().Message(), 200)),
                       file);
    }
    return world_T_parent * pose(parent_T_part);
  }
};

Status walk_link(Walk& walk, const sdf::Link& link, const std::string& model, const Pose3& world_T_link) {
  for (std::uint64_t i = 0; i < link.CollisionCount(); ++i) {
    const sdf::Collision& collision = *link.CollisionByIndex(i);
    auto world_T_collision = walk.place(collision.SemanticPose(), link.Name(), world_T_link, "");
    if (!world_T_collision) return pass_on(world_T_collision);
    walk.found.push_back({model, &link, &collision, *world_T_collision});
  }
  return {};
}

/// Collects the collisions of a model. `key` is its name in the state ("a::b"), `name` that in the world
/// ("a/b").
Status walk_model(Walk& walk, const sdf::Model& model, const std::string& key, const std::string& name,
                  const Pose3& world_T_model) {
  for (std::uint64_t i = 0; i < model.LinkCount(); ++i) {
    const sdf::Link& link = *model.LinkByIndex(i);
    auto world_T_link = walk.place(link.SemanticPose(), "__model__", world_T_model, key + "::" + link.Name());
    if (!world_T_link) return pass_on(world_T_link);
    if (auto walked = walk_link(walk, link, name, *world_T_link); !walked) return walked;
  }
  for (std::uint64_t i = 0; i < model.ModelCount(); ++i) {
    const sdf::Model& nested = *model.ModelByIndex(i);
    const std::string nested_key = key + "::" + nested.Name();
    auto world_T_nested = walk.place(nested.SemanticPose(), "__model__", world_T_model, nested_key);
    if (!world_T_nested) return pass_on(world_T_nested);
    if (auto walked = walk_model(walk, nested, nested_key, name + '/' + nested.Name(), *world_T_nested);
        !walked) {
      return walked;
    }
  }
  return {};
}

/// Returns the names "model/link/collision". A link or a collision that is the only one is omitted, and a
/// collision does not repeat the name of its link.
std::vector<std::string> solid_names(const std::vector<Found>& found) {
  std::map<std::string, std::set<const sdf::Link*>> links;
  for (const Found& one : found) links[one.model].insert(one.link);
  std::vector<std::string> names;
  for (const Found& one : found) {
    std::string name = one.model;
    if (links[one.model].size() > 1) name += '/' + one.link->Name();
    if (one.link->CollisionCount() > 1) {
      std::string last = one.collision->Name();
      const std::string prefix = one.link->Name() + '_';
      if (last.starts_with(prefix) && last.size() > prefix.size()) last.erase(0, prefix.size());
      name.append(1, '/').append(last);
    }
    names.push_back(is_printable(name) ? name : excerpt(name, name.size()));
  }
  return names;
}

// ---- World ---------------------------------------------------------------------------------------

Status add_solids(World& world, const std::vector<Found>& found, std::vector<FloorPlane>& floors,
                  const std::string& file) {
  SdfMeshes meshes;
  std::shared_ptr<const HeightField> terrain;
  UniqueNames taken;
  const std::vector<std::string> names = solid_names(found);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const sdf::Geometry& geometry = *found[i].collision->Geom();
    if (geometry.Type() == sdf::GeometryType::HEIGHTMAP) {
      auto field = sdf_terrain(*geometry.HeightmapShape(), found[i].world_T_collision);
      if (!field || terrain) {
        return bad_input(
            fmt::format("collision '{}': {}", names[i],
                        !field ? field.error().sentence : "a world has one heightmap; leave one"),
            file);
      }
      terrain = std::make_shared<const HeightField>(std::move(*field));
      continue;
    }
    auto pieces = sdf_pieces(geometry, meshes);
    if (!pieces) {
      const std::string& where = pieces.error().where;
      return bad_input(fmt::format("collision '{}': {}{}", names[i], where.empty() ? where : where + ": ",
                                   pieces.error().sentence),
                       file);
    }
    for (SdfPiece& piece : *pieces) {
      Solid solid{taken.take(names[i] + piece.suffix), found[i].world_T_collision * piece.collision_T_piece,
                  std::move(piece.shape)};
      if (!is_place(solid.world_T_solid.position)) {
        return bad_input(
            fmt::format("collision '{}' stands beyond 1e6 m, or nowhere; correct its <pose>", names[i]),
            file);
      }
      if (geometry.Type() == sdf::GeometryType::PLANE &&
          solid.world_T_solid.rotation.axes[2].z > 1.0 - 1e-9) {
        const auto size = geometry.PlaneShape()->Size();
        const bool known = is_size(size.X()) && is_size(size.Y());
        floors.push_back({solid.world_T_solid.position, known ? Vec2{size.X(), size.Y()} : Vec2{}});
      }
      world.solids.push_back(std::move(solid));
      if (world.solids.size() > most_solids) {
        return bad_input(
            fmt::format("the world has more than {} collisions, the most that is read", most_solids), file);
      }
    }
  }
  if (terrain) world = world.on(std::move(terrain));
  return {};
}

Status set_gravity(World& world, const ignition::math::Vector3d& gravity, const std::string& file) {
  const Vec3 g = vec(gravity);
  if (!is_place(g) || norm(xy(g)) > 1e-9 * std::abs(g.z) || g.z >= 0.0) {
    return bad_input(
        fmt::format("gravity {} {} {} does not point straight down; write e.g. <gravity>0 0 -9.8</gravity>",
                    g.x, g.y, g.z),
        file);
  }
  world.gravity_mps2 = -g.z;
  return {};
}

Outcome<std::vector<Found>> find_collisions(const sdf::World& parsed, const RepairedSdf& repaired,
                                            const std::string& file) {
  Walk walk{repaired.stated, file, {}};
  for (std::uint64_t i = 0; i < parsed.ModelCount(); ++i) {
    const sdf::Model& model = *parsed.ModelByIndex(i);
    auto world_T_model = walk.place(model.SemanticPose(), "world", {}, model.Name());
    if (!world_T_model) return pass_on(world_T_model);
    if (auto walked = walk_model(walk, model, model.Name(), model.Name(), *world_T_model); !walked) {
      return pass_on(walked);
    }
  }
  if (walk.found.empty())
    return bad_input("nothing in it has a collision; there is no world to plan in", file);
  return std::move(walk.found);
}

Status check_folders(const std::string& model_path) {
  for (const std::string& folder : parts_of_path(model_path)) {
    if (file_kind(folder) != FileKind::folder)
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
  SdfWarnings warnings;
  auto repaired = repair_sdf(text, name, options.model_path, warnings);
  if (!repaired) return pass_on(repaired);
  auto root = parse_sdf(*repaired, name);
  if (!root) return pass_on(root);
  const sdf::World* parsed = root->WorldByIndex(0);
  if (parsed == nullptr) return bad_input("sdformat finds no world in it", name);
  auto found = find_collisions(*parsed, *repaired, name);
  if (!found) return refused(found.error(), warnings);

  World world;
  world.name = excerpt(parsed->Name());
  if (auto gravity = set_gravity(world, parsed->Gravity(), name); !gravity) return pass_on(gravity);
  std::vector<FloorPlane> floors;
  if (auto added = add_solids(world, *found, floors, name); !added) return pass_on(added);
  if (repaired->bare && floors.empty()) {
    world.solids.insert(world.solids.begin(), Solid{"floor", {}, HalfSpaceShape{}});
    floors.push_back({});
  }
  if (auto floor = set_floor_and_bounds(world, floors, name); !floor) return refused(floor.error(), warnings);
  return LoadedWorld{std::move(world), warnings.sentences()};
}

Outcome<LoadedWorld> load_sdf(const std::string& path, const SdfOptions& options) {
  auto text = read_file(path, largest_world_bytes);
  if (!text) return pass_on(text);
  return sdf_from_text(*text, path, options);
}

}  // namespace outrider
