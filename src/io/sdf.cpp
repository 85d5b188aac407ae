#include "outrider/io/sdf.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iostream>
#include <map>
#include <numbers>
#include <optional>
#include <sdf/sdf.hh>
#include <set>
#include <sstream>

#include "outrider/io/files.hpp"
#include "outrider/io/mesh.hpp"
#include "sdf_floor.hpp"
#include "sdf_repair.hpp"
#include "text.hpp"

namespace outrider {
namespace {

constexpr double farthest_m = 1e6;
constexpr std::size_t most_world_triangles = 2'000'000;
constexpr std::size_t most_solids = 200'000;
constexpr std::size_t largest_world_bytes = std::size_t{64} << 20;

/// Swallows what libraries print on std::cerr while it lives.
class MutedErrors {
 public:
  MutedErrors() : before_(std::cerr.rdbuf(sink_.rdbuf())) {}
  MutedErrors(const MutedErrors&) = delete;
  MutedErrors& operator=(const MutedErrors&) = delete;
  ~MutedErrors() { std::cerr.rdbuf(before_); }

 private:
  std::ostringstream sink_;
  std::streambuf* before_;
};

Vec3 vec(const ignition::math::Vector3d& v) { return {v.X(), v.Y(), v.Z()}; }

Pose3 pose(const ignition::math::Pose3d& p) {
  return {vec(p.Pos()), {{vec(p.Rot().XAxis()), vec(p.Rot().YAxis()), vec(p.Rot().ZAxis())}}};
}

bool is_near(Vec3 p) {  // false for NaN too
  return std::abs(p.x) <= farthest_m && std::abs(p.y) <= farthest_m && std::abs(p.z) <= farthest_m;
}

bool is_size(double size_m) { return size_m > 0.0 && size_m <= farthest_m; }

// ---- Shapes --------------------------------------------------------------------------------------

/// A shape and where it stands in its collision.
struct Piece {
  Shape shape;
  Pose3 collision_T_piece = {};
  std::string suffix = {};
};
using Pieces = std::vector<Piece>;

/// The rotation that takes +z to a direction.
Rotation upward(Vec3 normal) {
  const Vec3 z = (1.0 / norm(normal)) * normal;
  if (z.z >= 1.0) return {};
  const Vec3 helper = std::abs(z.z) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0};
  const Vec3 across = cross(helper, z);
  const Vec3 x = (1.0 / norm(across)) * across;
  return {{x, cross(z, x), z}};
}

/// Triangles around an ellipsoid: a sphere's, stretched, and grown so that no face cuts into it.
MeshShape ellipsoid(Vec3 radii) {
  constexpr int rings = 24;
  constexpr int sides = 48;
  const double grow = 1.0 / (std::cos(std::numbers::pi / (2 * rings)) * std::cos(std::numbers::pi / sides));
  const auto point = [&](int ring, int side) {
    const double polar = std::numbers::pi * ring / rings;
    const Vec2 around = direction(2.0 * std::numbers::pi * (side % sides) / sides);
    const double out = ring == 0 || ring == rings ? 0.0 : std::sin(polar);
    return Vec3{grow * radii.x * out * around.x, grow * radii.y * out * around.y,
                grow * radii.z * std::cos(polar)};
  };
  MeshShape mesh;
  for (int ring = 0; ring < rings; ++ring) {
    for (int side = 0; side < sides; ++side) {
      const Vec3 a = point(ring, side);
      const Vec3 b = point(ring + 1, side);
      const Vec3 c = point(ring + 1, side + 1);
      const Vec3 d = point(ring, side + 1);
      if (ring + 1 < rings) mesh.triangles.push_back({a, b, c});
      if (ring > 0) mesh.triangles.push_back({a, c, d});
    }
  }
  return mesh;
}

/// Reads each mesh once.
struct Meshes {
  std::map<std::string, std::vector<Triangle>> by_path;
  std::size_t placed = 0;  ///< triangles in the world so far

  Outcome<MeshShape> shape(const sdf::Mesh& mesh) {
    const Vec3 scale = vec(mesh.Scale());
    if (!is_near(scale) || scale.x * scale.y * scale.z == 0.0)
      return bad_input("its mesh's scale is 0 or no number");
    auto found = by_path.find(mesh.Uri());
    if (found == by_path.end()) {
      auto loaded = load_mesh(mesh.Uri());
      if (!loaded) return pass_on(loaded);
      found = by_path.emplace(mesh.Uri(), std::move(*loaded)).first;
    }
    placed += found->second.size();
    if (placed > most_world_triangles) {
      return bad_input(fmt::format("the world's meshes have more than {} triangles; use simpler ones",
                                   most_world_triangles));
    }
    MeshShape result{found->second};
    for (Triangle& triangle : result.triangles) {
      for (Vec3& p : triangle) p = {scale.x * p.x, scale.y * p.y, scale.z * p.z};
    }
    return result;
  }
};

tl::unexpected<Fault> bad_size() {
  return bad_input("its size is not above 0 and at most 1e6 m; correct it");
}

Outcome<Pieces> round_pieces(double radius_m, double length_m, bool capped) {
  if (!is_size(radius_m) || !is_size(length_m)) return bad_size();
  Pieces pieces = {{CylinderShape{radius_m, 0.5 * length_m}}};
  if (!capped) return pieces;
  pieces.push_back({SphereShape{radius_m}, {{0, 0, 0.5 * length_m}, {}}, "_top"});
  pieces.push_back({SphereShape{radius_m}, {{0, 0, -0.5 * length_m}, {}}, "_bottom"});
  return pieces;
}

Outcome<Pieces> pieces_of(const sdf::Geometry& geometry, Meshes& meshes) {
  switch (geometry.Type()) {
    case sdf::GeometryType::BOX: {
      const Vec3 size = vec(geometry.BoxShape()->Size());
      if (!is_size(size.x) || !is_size(size.y) || !is_size(size.z)) return bad_size();
      return Pieces{{BoxShape{0.5 * size}}};
    }
    case sdf::GeometryType::CYLINDER:
      return round_pieces(geometry.CylinderShape()->Radius(), geometry.CylinderShape()->Length(), false);
    case sdf::GeometryType::CAPSULE:
      return round_pieces(geometry.CapsuleShape()->Radius(), geometry.CapsuleShape()->Length(), true);
    case sdf::GeometryType::SPHERE:
      if (!is_size(geometry.SphereShape()->Radius())) return bad_size();
      return Pieces{{SphereShape{geometry.SphereShape()->Radius()}}};
    case sdf::GeometryType::ELLIPSOID: {
      const Vec3 radii = vec(geometry.EllipsoidShape()->Radii());
      if (!is_size(radii.x) || !is_size(radii.y) || !is_size(radii.z)) return bad_size();
      return Pieces{{ellipsoid(radii)}};
    }
    case sdf::GeometryType::PLANE: {
      const Vec3 normal = vec(geometry.PlaneShape()->Normal());
      if (!is_near(normal) || norm(normal) < 1e-6) return bad_input("its plane's normal is no direction");
      return Pieces{{HalfSpaceShape{}, {{}, upward(normal)}}};
    }
    case sdf::GeometryType::MESH: {
      auto mesh = meshes.shape(*geometry.MeshShape());
      if (!mesh) return pass_on(mesh);
      return Pieces{{std::move(*mesh)}};
    }
    default: return Pieces{};
  }
}

// ---- Poses and names -----------------------------------------------------------------------------

/// One collision, found in the tree of models.
struct Found {
  std::string model;  ///< with the models around it, by '/'
  const sdf::Link* link = nullptr;
  const sdf::Collision* collision = nullptr;
  Pose3 world_T_collision;
};

struct Walk {
  const std::map<std::string, Pose3>& stated;
  const std::string& file;
  std::vector<Found> found = {};

  /// The world pose of a part: what the state says, or its place in its parent.
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

/// `key` names the model in the state ("a::b"), `name` in the world ("a/b").
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

/// "model/link/collision", where a link or a collision that is the only one says nothing, and a
/// collision does not repeat its link.
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

std::string unique(std::string name, std::set<std::string>& taken) {
  const std::string wanted = name;
  for (int i = 2; !taken.insert(name).second; ++i) name = fmt::format("{}_{}", wanted, i);
  return name;
}

// ---- World ---------------------------------------------------------------------------------------

Status add_solids(World& world, const std::vector<Found>& found, std::vector<FloorPlane>& floors,
                  const std::string& file) {
  Meshes meshes;
  std::set<std::string> taken;
  const std::vector<std::string> names = solid_names(found);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const sdf::Geometry& geometry = *found[i].collision->Geom();
    auto pieces = pieces_of(geometry, meshes);
    if (!pieces) {
      const std::string& where = pieces.error().where;
      return bad_input(fmt::format("collision '{}': {}{}", names[i], where.empty() ? where : where + ": ",
                                   pieces.error().sentence),
                       file);
    }
    for (Piece& piece : *pieces) {
      Solid solid{unique(names[i] + piece.suffix, taken),
                  found[i].world_T_collision * piece.collision_T_piece, std::move(piece.shape)};
      if (!is_near(solid.world_T_solid.position)) {
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
  return {};
}

Status set_gravity(World& world, const ignition::math::Vector3d& gravity, const std::string& file) {
  const Vec3 g = vec(gravity);
  if (!is_near(g) || norm(xy(g)) > 1e-9 * std::abs(g.z) || g.z >= 0.0) {
    return bad_input(
        fmt::format("gravity {} {} {} does not point straight down; write e.g. <gravity>0 0 -9.8</gravity>",
                    g.x, g.y, g.z),
        file);
  }
  world.gravity_mps2 = -g.z;
  return {};
}

/// sdformat's own reading of the repaired text, with every failure of it as a fault.
Outcome<sdf::Root> parse(const std::string& text, const std::string& file) {
  const MutedErrors muted;
  sdf::ParserConfig config;
  config.SetWarningsPolicy(sdf::EnforcementPolicy::LOG);
  config.SetUnrecognizedElementsPolicy(sdf::EnforcementPolicy::LOG);
  try {
    sdf::Root root;
    const sdf::Errors errors = root.LoadSdfString(text, config);
    if (!errors.empty()) {
      const auto line = errors.front().LineNumber();
      return bad_input(fmt::format("sdformat refuses it: {}", excerpt(errors.front().Message(), 200)),
                       line ? fmt::format("{}:{}", file, *line) : file);
    }
    return root;
  } catch (const std::exception& error) {
    return bad_input(fmt::format("sdformat refuses it: {}", excerpt(error.what(), 200)), file);
  } catch (const sdf::Exception& error) {
    return bad_input(fmt::format("sdformat refuses it: {}", excerpt(error.GetErrorStr(), 200)), file);
  }
}

Outcome<std::vector<Found>> find_collisions(const sdf::World& parsed, const RepairedSdf& repaired,
                                            const std::string& file) {
  Walk walk{repaired.stated, file};
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

}  // namespace

std::vector<Option> describe(SdfOptions& options) {
  return {{"model_path", "", 0.0, 0.0, "folders, separated by ':', in which model:// names are looked up",
           &options.model_path}};
}

Outcome<LoadedWorld> sdf_from_text(std::string_view text, const std::string& name,
                                   const SdfOptions& options) {
  SdfWarnings warnings;
  auto repaired = repair_sdf(text, name, options.model_path, warnings);
  if (!repaired) return pass_on(repaired);
  auto root = parse(repaired->text, name);
  if (!root) return pass_on(root);
  const sdf::World* parsed = root->WorldByIndex(0);
  if (parsed == nullptr) return bad_input("sdformat finds no world in it", name);
  auto found = find_collisions(*parsed, *repaired, name);
  if (!found) return pass_on(found);

  World world;
  world.name = excerpt(parsed->Name());
  if (auto gravity = set_gravity(world, parsed->Gravity(), name); !gravity) return pass_on(gravity);
  std::vector<FloorPlane> floors;
  if (auto added = add_solids(world, *found, floors, name); !added) return pass_on(added);
  if (repaired->bare && floors.empty()) {
    world.solids.insert(world.solids.begin(), Solid{"floor", {}, HalfSpaceShape{}});
    floors.push_back({});
  }
  if (auto floor = set_floor_and_bounds(world, floors, name); !floor) return pass_on(floor);
  return LoadedWorld{std::move(world), warnings.sentences()};
}

Outcome<LoadedWorld> load_sdf(const std::string& path, const SdfOptions& options) {
  auto text = read_file(path, largest_world_bytes);
  if (!text) return pass_on(text);
  return sdf_from_text(*text, path, options);
}

}  // namespace outrider
