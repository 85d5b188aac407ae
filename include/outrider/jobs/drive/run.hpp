// run_drive() simulates a whole drive: what the robot does, what it believes, and the errors of its belief.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "outrider/control/calibrate.hpp"
#include "outrider/job/watch.hpp"
#include "outrider/jobs/drive/mission/mission.hpp"
#include "outrider/log/messages/motion_messages.hpp"
#include "outrider/sim/faults/drive_sim_params.hpp"
#include "outrider/sim/simulated_robot.hpp"

namespace outrider {

/// Drives the task with a simulated robot, and logs the drive. If `rendered` is true, images are rendered and
/// tags are detected in them (sim/sensors/tag_camera.hpp); otherwise a model gives the observations of tags
/// (sim/sensors/tag_model.hpp). The status is "done" if the robot reached every stop, passed the other
/// waypoints and touched nothing,
/// "unconfirmed" if it believes so but the tags do not confirm every stop, "doubtful" if a tag often
/// contradicted the others, and "not_done" otherwise. A pure function of its arguments. `watch` receives the
/// fraction of the stops that are reached. Metrics:
///   driven_m, ideal_m      of the true centre of the robot; along straight legs through the waypoints
///   turned_rad, ideal_rad  the same of the heading
///   tag_fraction           fraction of the images with a tag that corrected the belief
///   ideal_s                least time of the course (control/timed_path.hpp), with the pause at each stop
///   time_s                 until the last stop, or the end of a drive that did not come to it
///   clearance_m            least distance of the robot's middle to an obstacle or the edge, at most the
///                          radius and 1 m
///   deviation_m            largest distance of the robot's centre from the straight legs
///   belief_error_m         largest error of the believed position, m
///   belief_error_ratio     the same in standard deviations of the belief (Mahalanobis distance)
///   tolerance_m, tolerance_rad  by how much the robot may be off at a stop that is reached
/// and the table "waypoints" has the waypoints, what became of each, and the errors at them.
Report run_drive(const DriveTask& task, const DriveSimParams& params, bool rendered, std::uint64_t seed,
                 Log& log, const RunWatch& watch = {});

/// The way straight from waypoint to waypoint, and the turns from heading to heading where it stops.
struct DriveLegs {
  double driven_m = 0.0;
  double turned_rad = 0.0;
};
DriveLegs straight_legs(const DriveTask& task);

/// Logs the tags that the robot knows, and the camera that sees them, if there are any.
void log_tags(Log& log, const DriveTask& task);
/// Logs what stands still: the world, the tags, the camera and the waypoints.
void log_start(Log& log, const DriveTask& task, std::uint64_t seed);

/// Returns the waypoints as they are logged at first: none is reached.
outrider_msgs::Waypoints waypoints_message(const DriveTask& task);

/// Makes the robot of run_drive(), at the start. In the open loop its camera is blind.
SimulatedRobot simulated_driver(const DriveTask& task, const DriveSimParams& params, bool rendered,
                                std::uint64_t seed);

/// Returns runs for the calibration of that robot. For each direction and each of 5 durations it drives
/// `repeats` times from rest to rest with a full battery at the speeds of the task. The measured ends have
/// errors of `sigma_m` and `sigma_rad`.
std::vector<CalibrationRun> record_runs(const DriveTask& task, const DriveSimParams& params, int repeats,
                                        double sigma_m, double sigma_rad, std::uint64_t seed);

}  // namespace outrider
