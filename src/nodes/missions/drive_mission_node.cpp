#include "outrider/nodes/missions/drive_mission_node.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "missions/limits.hpp"
#include "outrider/core/text.hpp"
#include "outrider/core/units.hpp"
#include "outrider/job/scene.hpp"
#include "outrider/jobs/drive/run.hpp"
#include "outrider/log/append.hpp"
#include "outrider/log/topics.hpp"
#include "outrider/nodes/missions/in_the_way.hpp"

namespace outrider {
namespace {

constexpr double belief_every_s = 0.2;
constexpr double straight_rad = radians(2.0);
constexpr double commands_kept_s = 3.0;
constexpr double braking_mps2 = 0.5;  // at which it slows down
constexpr double speeds_up_s = 1.0;   // from rest to full speed
constexpr double least_rate = 0.2;    // of full speed, for which it looks ahead while it stands

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
    : MissionNode("drive", options.node), task_(std::move(options.task)), sight_(task_.tags) {
  task_.eye.latency_s = std::max(task_.eye.latency_s, options.latency_s);
  listen<sensor_msgs::CameraInfo>("camera/camera_info", Delivery::sensor,
                                  [this](const auto& info) { return take_sight(info); });
  listen<sensor_msgs::Image>("camera/image_raw", Delivery::sensor,
                             [this](const auto& image) { return take_sight(image); });
  listen<apriltag_msgs::AprilTagDetectionArray>(
      "detections", Delivery::sensor, [this](const auto& detections) { return take_sight(detections); });
  listen_to_scan();
  listen_to_mounts();
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
  const auto robot_T_camera = frames().robot_T(camera_frame_);
  if (!robot_T_camera) return {};
  const Vec3 ahead = robot_T_camera->rotation.axes[2], down = robot_T_camera->rotation.axes[1];
  if (!(ahead.x >= std::cos(straight_rad)) || !(down.z <= -std::cos(straight_rad))) {
    return bad_input(
        fmt::format("'{}' does not look straight ahead on '{}'; the job drive needs a camera that does",
                    excerpt(camera_frame_), options().frames.base));
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
  solids_.emplace(footprints_above_floor(task_.world), RangeFinderModel());
  clock_.begin(now_s());
}

Observation DriveMissionNode::observation() const {
  Observation seen;
  seen.time_s = clock_.time_s();
  seen.image = sight_.newest();
  if (seen.image) seen.image->taken_s = clock_.time_at(seen.image->taken_s);
  return seen;
}

/// Drives at a part of the speed that the mission wants.
void DriveMissionNode::drive(double rate) {
  const Twist2 twist = rate * twist_;
  sent_.emplace_back(now_s(), twist);
  while (now_s() - sent_.front().first > commands_kept_s) sent_.pop_front();
  command(twist);
}

/// Returns the pose of the robot now, by its commands, as seen from where it was at that time.
Pose2 DriveMissionNode::moved_since(double time_s) const {
  Pose2 pose;
  for (std::size_t i = 0; i < sent_.size(); ++i) {
    const double until_s = i + 1 < sent_.size() ? sent_[i + 1].first : now_s();
    const double from_s = std::max(sent_[i].first, time_s);
    if (until_s > from_s) pose = moved(pose, sent_[i].second, until_s - from_s);
  }
  return pose;
}

/// Notes what the newest scan shows and the map does not have.
void DriveMissionNode::note_unmapped() {
  if (!scan().came_s() || scan().time_s() == unmapped_s_) return;
  unmapped_s_ = scan().time_s();
  unmapped_.clear();
  const Pose2 world_T_then =
      compose(mission_->reckoning.belief.world_T_robot, inverse(moved_since(unmapped_s_)));
  std::ranges::copy_if(scan().points(), std::back_inserter(unmapped_), [&](Vec2 point) {
    return solids_->surface_distance(world_T_then * point, 2.0 * on_map_m) > on_map_m;
  });
}

/// Returns what is in the way, on the map.
std::optional<Vec2> DriveMissionNode::thing_ahead() {
  note_unmapped();
  const StopRule rule = stop_rule(task_.radius_m, braking_mps2);
  const Pose2 then_T_now = moved_since(unmapped_s_);
  const auto thing = in_the_way(unmapped_, then_T_now, std::max(clock_.rate(), least_rate) * twist_, rule);
  if (!thing) return std::nullopt;
  return compose(mission_->reckoning.belief.world_T_robot, inverse(then_T_now)) * *thing;
}

/// Records an arrival at a waypoint. Its error is unknown, because nobody reports the true pose.
void DriveMissionNode::note_arrival(const DriveArrival& arrival) {
  const bool reached = arrival.doubt.empty();
  const std::string sentence = fmt::format("waypoint {} {}{}", arrival.waypoint + 1,
                                           reached ? "reached" : "unconfirmed: ", arrival.doubt);
  if (reached) {
    waypoints_.waypoints[arrival.waypoint].reached = mission_s();
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
      if (auto ok = mount(); !ok) return end(ok.error());
    }
    start();
  }
  const std::string why = why_scan_is_missing();
  const auto thing = why.empty() ? thing_ahead() : std::nullopt;
  const double slower = braking_mps2 / std::max(speed_of(twist_), 0.05);
  clock_.advance(now_s(), why.empty() && !thing ? 1.0 / speeds_up_s : -slower);
  if (clock_.time_s() + soon_s >= until_s_) {
    const auto next = mission_->step(observation());
    note();
    if (!next) return finish();
    const auto& wheels = std::get<DriveWheels>(*next);
    twist_ = twist_of(task_.chassis, wheels.wheels);
    until_s_ = wheels.until_s;
  }
  drive(clock_.rate());
  const Vec2 robot = mission_->reckoning.belief.world_T_robot.position;
  if (thing) {
    stand_before(*thing, robot);
  } else if (!why.empty()) {
    set_status(NodeLevel::error, "stopped", why);
  } else {
    way_is_free(robot);
    set_status(NodeLevel::info, "driving", fmt::format("to waypoint {}", mission_->arrivals.size() + 1));
  }
}

}  // namespace outrider
