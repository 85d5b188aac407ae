#include "outrider/nodes/tag_sim_node.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "outrider/job/sensor_log.hpp"
#include "outrider/jobs/drive/run.hpp"
#include "outrider/log/conversions.hpp"
#include "outrider/log/ros_sensor_messages.hpp"
#include "outrider/nodes/tag_sight.hpp"

namespace outrider {
namespace {

constexpr double step_s = 0.05;
constexpr const char* odom_frame = "odom";
constexpr const char* base_frame = "base_link";
constexpr const char* camera_frame = "camera_optical_frame";

sensor_msgs::Image image_message(const CameraImage& image, const std_msgs::Header& header) {
  sensor_msgs::Image message;
  message.header = header;
  message.width = static_cast<std::uint32_t>(image.width);
  message.height = static_cast<std::uint32_t>(image.height);
  message.encoding = "mono8";
  message.step = message.width;
  message.data = image.values;
  return message;
}

}  // namespace

TagSimNode::TagSimNode(const DriveSetup& setup, const TagSimNodeOptions& options)
    : Node("sim", step_s),
      options_(options),
      chassis_(setup.task.chassis),
      eye_(setup.task.eye),
      robot_(simulated_driver(setup.task, setup.sim, setup.rendered, options.seed)),
      sensors_(options.faults, Rng(options.seed).child("lost measurements")),
      commands_(options.faults, Rng(options.seed).child("lost commands")) {
  if (options_.plain_twist) {
    listen<geometry_msgs::Twist>("cmd_vel", Delivery::reliable,
                                 [this](const auto& twist) { return take_command(twist); });
  } else {
    listen<geometry_msgs::TwistStamped>("cmd_vel", Delivery::reliable,
                                        [this](const auto& stamped) { return take_command(stamped.twist); });
  }
  info_output_ = add_output<sensor_msgs::CameraInfo>("camera/camera_info", Delivery::sensor);
  image_output_ = add_output<sensor_msgs::Image>("camera/image_raw", Delivery::sensor);
  detection_output_ = add_output<apriltag_msgs::AprilTagDetectionArray>("detections", Delivery::reliable);
  odometry_output_ = add_output<nav_msgs::Odometry>("odom", Delivery::reliable);
  transform_output_ = add_output<tf2_msgs::TFMessage>("/tf", Delivery::reliable);
  mount_output_ = add_output<tf2_msgs::TFMessage>("/tf_static", Delivery::latched);
  clock_output_ = add_output<rosgraph_msgs::Clock>("/clock", Delivery::reliable);
  pose_output_ = add_output<geometry_msgs::PoseStamped>("~/pose", Delivery::reliable);
}

Status TagSimNode::take_command(const geometry_msgs::Twist& twist) {
  const Twist2 command{twist.linear.x, twist.linear.y, twist.angular.z};
  if (!std::isfinite(command.ahead_mps) || !std::isfinite(command.left_mps) ||
      !std::isfinite(command.turn_radps))
    return bad_input(fmt::format("the command {:g}, {:g} m/s, {:g} rad/s is not finite", command.ahead_mps,
                                 command.left_mps, command.turn_radps));
  commands_.push(now_s(), command);
  return {};
}

template <class Message>
void TagSimNode::send_late(std::size_t output, const Message& message) {
  sensors_.push(now_s(), {output, encode(MessageEncoding::cdr, message)});
}

void TagSimNode::send_sight(const TagImage& image) {
  const std_msgs::Header header = header_of(*began_s_ + image.taken_s, camera_frame);
  sensor_msgs::CameraInfo info = camera_message(eye_.camera);
  info.header = header;
  send_late(info_output_, info);
  const RenderedImage* rendered = robot_.devices().camera->rendered();
  if (options_.images && rendered != nullptr) {
    send_late(image_output_, image_message(rendered->image, header));
  } else {
    send_late(detection_output_, detections_of(image, eye_.camera, header));
  }
}

void TagSimNode::measure() {
  const Observation seen = robot_.sense();
  const double time_s = *began_s_ + seen.time_s;
  nav_msgs::Odometry odometry;
  odometry.header = header_of(time_s, odom_frame);
  odometry.child_frame_id = base_frame;
  odometry.pose.pose = pose_of(odometry_);
  odometry.twist.twist.linear.x = wanted_.ahead_mps;
  odometry.twist.twist.linear.y = wanted_.left_mps;
  odometry.twist.twist.angular.z = wanted_.turn_radps;
  send_late(odometry_output_, odometry);
  tf2_msgs::TFMessage transforms;
  transforms.transforms.push_back(transform_of(time_s, odometry_, odom_frame, base_frame));
  send_late(transform_output_, transforms);
  if (seen.image && seen.image->taken_s > image_s_) {
    image_s_ = seen.image->taken_s;
    send_sight(*seen.image);
  }
  send(pose_output_, stamped(time_s, robot_.pose(), "world"));
  send(clock_output_, rosgraph_msgs::Clock{stamp_of(time_s)});
}

void TagSimNode::step() {
  while (const auto command = commands_.take(now_s())) {
    wanted_ = *command;
    command_s_ = now_s();
  }
  if (now_s() - command_s_ > options_.patience_s) wanted_ = {};
  robot_.act(DriveWheels{wheel_speeds(chassis_, wanted_), robot_.time_s() + step_s});
  odometry_ = moved(odometry_, wanted_, step_s);
  measure();
}

/// The axes of a camera that looks ahead: x to the right, y down, z ahead.
void TagSimNode::send_mount() {
  tf2_msgs::TFMessage mount;
  mount.transforms.push_back(transform_of(*began_s_, {{eye_.ahead_m, 0.0}, 0.0}, base_frame, camera_frame));
  geometry_msgs::Transform& transform = mount.transforms.back().transform;
  transform.translation.z = eye_.height_m;
  transform.rotation = {-0.5, 0.5, -0.5, 0.5};
  send(mount_output_, mount);
}

void TagSimNode::act() {
  if (!began_s_) {
    began_s_ = now_s();
    measure();
  }
  if (!std::exchange(mounted_, true)) {
    send_mount();
  }
  while (*began_s_ + robot_.time_s() + step_s <= now_s() + 1e-9) step();
  while (auto measured = sensors_.take(now_s())) send_bytes(std::move(*measured));
  const bool commanded = now_s() - command_s_ <= options_.patience_s;
  set_status(NodeLevel::info, commanded ? "commanded" : "idle",
             commanded ? "commands come"
                       : fmt::format("no command has come for {:g} s, so it stands", options_.patience_s));
}

}  // namespace outrider
