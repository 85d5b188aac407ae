#include "outrider/io/sdf/robot_file.hpp"

#include <fmt/format.h>

#include <limits>

#include "outrider/core/options.hpp"
#include "outrider/geometry/convex.hpp"
#include "outrider/io/files/files.hpp"
#include "sdf/sdf_scene.hpp"
#include "sdf/sdf_shapes.hpp"

namespace outrider {
namespace {

/// Returns the solids of a robot in the frame of its model.
Outcome<std::vector<Solid>> robot_solids(SdfFiles& files, const SdfScene& scene, const std::string& path) {
  auto poses = collision_poses(scene);
  if (!poses) return pass_on(poses);
  std::vector<Solid> solids;
  SdfMeshes meshes;
  for (std::size_t i = 0; i < poses->size(); ++i) {
    const SdfCollision& one = scene.collisions[i];
    if (one_of(one.shape.name(), {"plane", "heightmap"})) {
      return bad_input(
          fmt::format("a robot is no {}; leave out the collision '{}'", one.shape.name(), one.name),
          one.file->document.where(one.shape));
    }
    auto pieces = sdf_pieces(files, *one.file, one.shape, one.mesh, meshes);
    if (!pieces) return pass_on(pieces);
    for (SdfPiece& piece : *pieces)
      solids.push_back({one.name, (*poses)[i] * piece.collision_T_piece, std::move(piece.shape)});
  }
  if (solids.empty()) return bad_input("the robot has no collisions; give it an outline", path);
  return solids;
}

}  // namespace

Outcome<RobotFile> load_robot(const std::string& path, const SdfOptions& options) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  auto text = read_file(path);
  if (!text) return pass_on(text);
  SdfFiles files(options.model_path);
  auto file = files.parse(*text, path);
  if (!file) return pass_on(file);
  auto scene = scan_sdf(files, **file);
  if (!scene) return pass_on(scene);
  auto solids = robot_solids(files, *scene, path);
  if (!solids) return pass_on(solids);
  auto frames = frame_poses(*scene, 1);
  if (!frames) return pass_on(frames);

  const Pose3 world_T_model = scene->frames[scene->scopes[1].frame].pose;
  Pose3 world_T_robot = world_T_model;
  for (const char* base : {"base_link", "base_footprint"}) {
    if (const auto found = frames->find(base); found != frames->end())
      world_T_robot = world_T_model * found->second;
  }
  RobotFile robot;
  Box3 box;
  for (Solid& solid : *solids) {
    solid.world_T_solid = inverse(world_T_robot) * solid.world_T_solid;
    box.include(bounds(solid).low);
    box.include(bounds(solid).high);
    for (const RoundedPolygon& piece : footprint(solid, -inf, inf)) {
      for (const Vec2 corner : piece.core) {
        robot.radius_m = std::max(robot.radius_m, norm(corner) + piece.radius_m);
        for (const Vec2 aside : {Vec2{-1, -1}, Vec2{-1, 1}, Vec2{1, -1}, Vec2{1, 1}})
          robot.outline.push_back(corner + piece.radius_m * aside);
      }
    }
  }
  robot.outline = convex_hull(std::move(robot.outline));
  robot.height_m = box.high.z - box.low.z;
  for (auto& [name, pose] : *frames) {
    Pose3 robot_T_frame = inverse(world_T_robot) * world_T_model * pose;
    robot_T_frame.position.z -= box.low.z;
    robot.robot_T_frame.emplace(name, robot_T_frame);
  }
  robot.warnings = files.warnings.sentences();
  return robot;
}

Outcome<Pose3> mount(const RobotFile& robot, const std::string& frame, const std::string& key) {
  if (const auto found = robot.robot_T_frame.find(frame); found != robot.robot_T_frame.end())
    return found->second;
  std::vector<std::string> known;
  for (const auto& [name, pose] : robot.robot_T_frame) known.push_back(name);
  return no_such_row("link or frame", frame, known, key);
}

Option describe_file(RobotFileOptions& options, std::string name) {
  return file_option(std::move(name), "URDF or SDF file of the robot, in place of its radius and height",
                     &options.file);
}

Option describe_link(RobotFileOptions& options) {
  return {"link",
          "",
          0,
          0,
          "link or frame of the robot's file that says where it stands; empty: as given here",
          &options.link};
}

Outcome<std::optional<Pose3>> take_robot_file(const RobotFileOptions& options, const std::string& link_key,
                                              const SdfOptions& sdf, double& radius_m, double& height_m,
                                              std::vector<std::string>& warnings) {
  if (options.file.empty()) {
    if (options.link.empty()) return std::optional<Pose3>();
    return bad_input("links are those of the robot's own file; name it, or leave the link out", link_key);
  }
  auto robot = load_robot(options.file, sdf);
  if (!robot) return pass_on(robot);
  radius_m = robot->radius_m;
  height_m = robot->height_m;
  warnings.insert(warnings.end(), robot->warnings.begin(), robot->warnings.end());
  if (options.link.empty()) return std::optional<Pose3>();
  auto found = mount(*robot, options.link, link_key);
  if (!found) return pass_on(found);
  return std::optional(*found);
}

}  // namespace outrider
