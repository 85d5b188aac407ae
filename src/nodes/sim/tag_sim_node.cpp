#include "outrider/nodes/sim/tag_sim_node.hpp"

#include <utility>

#include "outrider/job/sensor_log.hpp"
#include "outrider/jobs/drive/run.hpp"
#include "outrider/log/messages/conversions.hpp"
#include "outrider/log/messages/ros_sensor_messages.hpp"
#include "outrider/nodes/missions/tag_sight.hpp"

namespace outrider {
namespace {

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
    : RobotSimNode(simulated_driver(setup.task, setup.sim, setup.rendered, options.seed), options),
      images_(options.images),
      chassis_(setup.task.chassis),
      eye_(setup.task.eye) {
  info_output_ = add_output<sensor_msgs::CameraInfo>("camera/camera_info", Delivery::sensor);
  image_output_ = add_output<sensor_msgs::Image>("camera/image_raw", Delivery::sensor);
  detection_output_ = add_output<apriltag_msgs::AprilTagDetectionArray>("detections", Delivery::reliable);
}

Command TagSimNode::drive(const Twist2& twist, double until_s) {
  twist_ = twist;
  odometry_ = moved(odometry_, twist, step_s);
  return DriveWheels{wheel_speeds(chassis_, twist), until_s};
}

TagSimNode::Whereabouts TagSimNode::whereabouts(const Observation&) { return {odometry_, twist_, {}}; }

/// The axes of a camera that looks ahead: x to the right, y down, z ahead.
geometry_msgs::TransformStamped TagSimNode::mount(double time_s) const {
  auto mount = transform_of(time_s, {{eye_.ahead_m, 0.0}, 0.0}, base_frame, camera_frame);
  mount.transform.translation.z = eye_.height_m;
  mount.transform.rotation = {-0.5, 0.5, -0.5, 0.5};
  return mount;
}

void TagSimNode::send_sight(const TagImage& image) {
  const std_msgs::Header header = header_of(node_s(image.taken_s), camera_frame);
  sensor_msgs::CameraInfo info = camera_message(eye_.camera);
  info.header = header;
  send_late(info_output_, info);
  const RenderedImage* rendered = robot().devices().camera->rendered();
  if (images_ && rendered != nullptr) {
    send_late(image_output_, image_message(rendered->image, header));
  } else {
    send_late(detection_output_, detections_of(image, eye_.camera, header));
  }
}

void TagSimNode::send_measured(const Observation& seen, double /*time_s*/) {
  if (!seen.image || seen.image->taken_s <= image_s_) return;
  image_s_ = seen.image->taken_s;
  send_sight(*seen.image);
}

}  // namespace outrider
