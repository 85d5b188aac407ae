#include "outrider/nodes/drive_mission_node.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "outrider/core/text.hpp"
#include "outrider/core/units.hpp"
#include "outrider/jobs/drive/run.hpp"
#include "outrider/log/append.hpp"
#include "outrider/log/topics.hpp"

namespace outrider {
namespace {

constexpr double belief_every_s = 0.2;
constexpr double soon_s = 1e-6;
constexpr double straight_rad = radians(2.0);

std::string state_of(DriveEnd end) {
  switch (end) {
    case DriveEnd::done: return "done";
    case DriveEnd::unconfirmed: return "unconfirmed";
    case DriveEnd::doubtful: return "doubtful";
    case DriveEnd::lost: return "lost";
    case DriveEnd::none:
    case DriveEnd::stuck: break;
  }
  return "stuck";
}

}  // namespace

DriveMissionNode::DriveMissionNode(DriveMissionNodeOptions options)
    : MissionNode("drive", options.node),
      task_(std::move(options.task)),
      places_(options.node.frames),
      sight_(task_.tags) {
  task_.eye.latency_s = std::max(task_.eye.latency_s, options.latency_s);
  listen<sensor_msgs::CameraInfo>("camera/camera_info", Delivery::sensor,
                                  [this](const auto& info) { return take_sight(info); });
  listen<sensor_msgs::Image>("camera/image_raw", Delivery::sensor,
                             [this](const auto& image) { return take_sight(image); });
  listen<apriltag_msgs::AprilTagDetectionArray>(
      "detections", Delivery::sensor, [this](const auto& detections) { return take_sight(detections); });
  listen_to_transforms(places_);
  set_status(NodeLevel::info, "waiting", "no image with camera_info has come yet");
}

template <class Message>
Status DriveMissionNode::take_sight(const Message& message) {
  if (auto ok = sight_.take(message); !ok) return ok;
  camera_frame_ = message.header.frame_id;
  return {};
}

/// Takes the place of the camera from the transforms, if it is there.
Status DriveMissionNode::mount() {
  task_.eye.camera = *sight_.camera();
  const auto robot_T_camera = places_.robot_T(camera_frame_);
  if (!robot_T_camera) return {};
  const Vec3 ahead = robot_T_camera->rotation.axes[2], down = robot_T_camera->rotation.axes[1];
  if (!(ahead.x >= std::cos(straight_rad)) || !(down.z <= -std::cos(straight_rad))) {
    return bad_input(
        fmt::format("'{}' does not look straight ahead on '{}'; the job drive needs a camera that does",
                    printable(camera_frame_), options().frames.base));
  }
  task_.eye.ahead_m = robot_T_camera->position.x;
  task_.eye.height_m = robot_T_camera->position.z;
  return {};
}

void DriveMissionNode::start() {
  begin_log();
  log_start(log(), task_, 0);
  waypoints_ = waypoints_message(task_);
  log().append(topic::waypoints, 0.0, waypoints_);
  mission_.emplace(outrider::begin(task_));
}

Observation DriveMissionNode::observation() const {
  Observation seen;
  seen.time_s = mission_s();
  seen.image = sight_.newest();
  if (seen.image) seen.image->taken_s = std::min(seen.image->taken_s - began_s(), seen.time_s);
  return seen;
}

/// How far the robot is off is unknown: nobody tells where it truly is.
void DriveMissionNode::note_arrival(const DriveArrival& arrival) {
  const bool reached = arrival.doubt.empty();
  const std::string sentence = fmt::format("waypoint {} {}{}", arrival.waypoint + 1,
                                           reached ? "reached" : "unconfirmed: ", arrival.doubt);
  if (reached) {
    waypoints_.waypoints[arrival.waypoint].reached = arrival.time_s;
    log().append(topic::waypoints, mission_s(), waypoints_);
  }
  log_event(log(), mission_s(), reached ? "arrive" : "unconfirmed", sentence);
  tell(reached ? NodeLevel::info : NodeLevel::warning, sentence);
}

/// Logs what is new.
void DriveMissionNode::note() {
  const double time_s = mission_s();
  const PoseBelief& belief = mission_->reckoning.belief;
  for (; arrivals_ < mission_->arrivals.size(); ++arrivals_) note_arrival(mission_->arrivals[arrivals_]);
  for (; relocalisations_ < mission_->relocalisations.size(); ++relocalisations_) {
    const Pose2& pose = mission_->relocalisations[relocalisations_].belief.world_T_robot;
    const std::string sentence = fmt::format("by tags the robot is at {:.2f}, {:.2f}, {:.0f} degrees",
                                             pose.position.x, pose.position.y, degrees(pose.heading_rad));
    log_event(log(), time_s, "relocalised", sentence);
    tell(NodeLevel::warning, sentence);
  }
  if (time_s < noted_s_ + belief_every_s - soon_s && mission_->end == DriveEnd::none) return;
  noted_s_ = time_s;
  log_belief(log(), time_s, belief.world_T_robot, belief.covariance, mission_->used > used_);
  used_ = mission_->used;
}

void DriveMissionNode::finish() {
  const auto confirmed =
      std::ranges::count_if(mission_->arrivals, [](const auto& a) { return a.doubt.empty(); });
  const std::string sentence =
      mission_->reason.empty() ? fmt::format("{} stops are reached", confirmed) : mission_->reason;
  end(mission_->end == DriveEnd::done ? NodeLevel::info : NodeLevel::error, state_of(mission_->end),
      sentence);
}

void DriveMissionNode::act() {
  if (is_over()) return command({});
  if (!mission_) {
    command({});
    if (task_.closed_loop) {
      if (!sight_.newest() || !sight_.camera()) return;
      if (auto ok = mount(); !ok) return end(NodeLevel::error, "bad_input", ok.error().sentence);
    }
    start();
  }
  if (mission_s() + soon_s >= until_s_) {
    const auto next = mission_->step(observation());
    note();
    if (!next) return finish();
    const auto& wheels = std::get<DriveWheels>(*next);
    twist_ = twist_of(task_.chassis, wheels.wheels);
    until_s_ = wheels.until_s;
  }
  command(twist_);
  set_status(NodeLevel::info, "driving", fmt::format("to waypoint {}", mission_->arrivals.size() + 1));
}

}  // namespace outrider
