// The first messages in the log of a drive.
#include <limits>

#include "outrider/job/scene.hpp"
#include "outrider/job/scene_markers.hpp"
#include "outrider/job/sensor_log.hpp"
#include "outrider/jobs/drive/run.hpp"
#include "outrider/log/append.hpp"
#include "outrider/log/conversions.hpp"
#include "outrider/log/motion_messages.hpp"
#include "outrider/log/topics.hpp"

namespace outrider {

outrider_msgs::Waypoints waypoints_message(const DriveTask& task) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  outrider_msgs::Waypoints message;
  message.closed_loop = task.closed_loop;
  for (const Waypoint& waypoint : task.waypoints) {
    message.waypoints.push_back({point_of(waypoint.pose.position),
                                 waypoint.pose.heading_rad,
                                 waypoint.stop,
                                 unknown,
                                 {unknown, unknown},
                                 unknown});
  }
  return message;
}

void log_start(Log& log, const DriveTask& task, std::uint64_t seed) {
  constexpr double any_m = std::numeric_limits<double>::infinity();  // every solid is in its way
  log_scene(log, run_info("drive", seed, task.world, task.radius_m), task.world, any_m);
  outrider_msgs::Tags tags;
  for (const Tag& tag : task.tags.tags) {
    tags.tags.push_back({tag.id, point_of(tag.world_T_tag.position),
                         heading_of(xy(-1.0 * tag.world_T_tag.rotation.axes[2])), tag.size_m});
  }
  const bool sees = task.closed_loop && !tags.tags.empty();
  if (!tags.tags.empty()) log.append(topic::tags, 0.0, std::move(tags));
  if (sees) {
    log_camera(log, task.eye.camera);
    log_mount(log, "camera", {{task.eye.ahead_m, 0.0}, 0.0}, task.eye.height_m);
  }
  std::vector<Vec2> way = {task.start.position};
  for (const Waypoint& waypoint : task.waypoints) way.push_back(waypoint.pose.position);
  log_plan(log, 0.0, way);
  log_markers(log);
}

}  // namespace outrider
