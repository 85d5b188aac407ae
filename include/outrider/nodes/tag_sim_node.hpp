// TagSimNode: a simulated robot on wheels with a camera that sees tags, behind topics.
//
//   cmd_vel  geometry_msgs/TwistStamped, or Twist   ->   camera/camera_info, detections
//                                                        camera/image_raw, if images are rendered and wanted
//                                                        odom, /tf, /tf_static, /clock
//                                                        sim/pose  geometry_msgs/PoseStamped: the true one
//
// It is the robot of the job drive (sim/wheel_body.hpp, sim/simulated_tag_camera.hpp), with its faults. The
// odometry is what the commands say, since nobody counts the turns of its wheels. The robot stops if no
// command has come for `patience`. What it measures and the commands to it are lost or late as `faults` says.
// Same options, messages and times: same outputs.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "outrider/jobs/drive/scenario.hpp"
#include "outrider/nodes/message_faults.hpp"
#include "outrider/nodes/node.hpp"
#include "outrider/sim/simulated_robot.hpp"

namespace outrider {

struct TagSimNodeOptions {
  std::uint64_t seed = 1;
  bool plain_twist = false;  ///< commands are Twist, not TwistStamped
  bool images = false;       ///< images are sent, and no detections
  double patience_s = 0.5;
  MessageFaults faults;
};

class TagSimNode final : public Node {
 public:
  TagSimNode(const DriveSetup& setup, const TagSimNodeOptions& options);

  [[nodiscard]] const SimulatedRobot& robot() const { return robot_; }

 private:
  Status take_command(const geometry_msgs::Twist& twist);
  void act() override;
  void step();
  void measure();
  void send_sight(const TagImage& image);
  void send_mount();
  template <class Message>
  void send_late(std::size_t output, const Message& message);

  TagSimNodeOptions options_;
  Chassis chassis_;
  TagEye eye_;
  SimulatedRobot robot_;
  FaultyLink<NodeOutput> sensors_;
  FaultyLink<Twist2> commands_;
  std::optional<double> began_s_;  ///< time of the node at which the simulation began
  Twist2 wanted_;
  Pose2 odometry_;
  double command_s_ = -std::numeric_limits<double>::infinity();
  double image_s_ = -std::numeric_limits<double>::infinity();  ///< time of the newest image that was sent
  bool mounted_ = false;
  std::size_t info_output_, image_output_, detection_output_, odometry_output_, transform_output_,
      mount_output_, clock_output_, pose_output_;
};

}  // namespace outrider
