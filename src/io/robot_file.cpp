#include "outrider/io/robot_file.hpp"

#include <fmt/format.h>

#include <limits>

#include "outrider/core/options.hpp"
#include "outrider/geometry/convex.hpp"
#include "outrider/io/files.hpp"
#include "sdf_scene.hpp"
#include "sdf_shapes.hpp"

namespace outrider {
namespace {

/// Returns the solids of a robot in the frame of its model.
Outcome<std::vector<Solid>> solids_of(SdfFiles& files, const SdfScene& scene, const std::string& path) {
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
  auto solids = solids_of(files, *scene, path);
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

}  // namespace outrider
