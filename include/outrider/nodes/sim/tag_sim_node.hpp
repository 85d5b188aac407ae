// TagSimNode: a simulated robot on wheels with a camera that sees tags, behind topics.
//
//   camera/camera_info, detections
//   camera/image_raw, if images are rendered and wanted
//
// and what every RobotSimNode sends. It is the robot of the job drive (sim/bodies/wheel_body.hpp,
// sim/sensors/simulated_tag_camera.hpp), with its faults. The odometry is what the commands say, since nobody
// counts the turns of its wheels. Same options, messages and times: same outputs.
#pragma once

#include <limits>

#include "outrider/jobs/drive/scenario.hpp"
#include "outrider/nodes/sim/robot_sim_node.hpp"

namespace outrider {

struct TagSimNodeOptions : RobotSimOptions {
  bool images = false;  ///< images are sent, and no detections
};

class TagSimNode final : public RobotSimNode {
 public:
  TagSimNode(const DriveSetup& setup, const TagSimNodeOptions& options);

 private:
  Command drive(const Twist2& twist, double until_s) override;
  Whereabouts whereabouts(const Observation& seen) override;
  [[nodiscard]] geometry_msgs::TransformStamped mount(double time_s) const override;
  void send_measured(const Observation& seen, double time_s) override;
  void send_sight(const TagImage& image);

  bool images_;
  Chassis chassis_;
  TagEye eye_;
  Twist2 twist_;  ///< of the newest step
  Pose2 odometry_;
  double image_s_ = -std::numeric_limits<double>::infinity();  ///< time of the newest image that was sent
  std::size_t info_output_, image_output_, detection_output_;
};

}  // namespace outrider
