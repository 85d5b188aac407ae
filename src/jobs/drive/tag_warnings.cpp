#include "tag_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "outrider/sim/sensors/simulated_tag_camera.hpp"
#include "outrider/sim/sensors/tag_model.hpp"

namespace outrider {

std::vector<std::string> tag_warnings(const DriveTask& task) {
  if (!task.closed_loop) return {};
  if (task.tags.tags.empty())
    return {"there are no tags, so a closed loop cannot confirm any stop; give tags, or take loop open"};
  const RobotCamera camera = robot_camera(task.eye);
  const CollisionMap ground = sight_lines(task.world, camera.robot_T_camera.position.z);
  std::vector<std::size_t> blind;
  for (std::size_t i = 0; i < task.waypoints.size(); ++i) {
    const Pose2& pose = task.waypoints[i].pose;
    const Pose3 world_T_robot{{pose.position.x, pose.position.y, 0.0},
                              Rotation::from_rpy(0.0, 0.0, pose.heading_rad)};
    const Pose3 world_T_camera = world_T_robot * camera.robot_T_camera;
    const bool sees = std::ranges::any_of(
        task.tags.tags, [&](const Tag& tag) { return in_view(tag, camera.camera, world_T_camera, ground); });
    if (task.waypoints[i].stop && !sees) blind.push_back(i + 1);
  }
  if (blind.empty()) return {};
  constexpr std::size_t most_named = 5;
  const std::size_t named = std::min(blind.size(), most_named);
  return {fmt::format(
      "no tag is in view at {} of the stops (waypoint {}{}), so a closed loop cannot confirm them",
      blind.size(), fmt::join(blind.begin(), blind.begin() + static_cast<std::ptrdiff_t>(named), ", "),
      blind.size() > named ? ", ..." : "")};
}

}  // namespace outrider
