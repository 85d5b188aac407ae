// DriveMissionNode: the mission of the job drive (jobs/drive/mission.hpp) with its robot behind topics.
//
//   camera/camera_info                 ->   cmd_vel; sideways too for mecanum and holonomic robots
//   camera/image_raw, or detections         drive/status  what it does, and which stops are confirmed
//   /tf_static: the camera's place          the channels of the run: /waypoints, /tags, /belief, ...
//
// The robot stands at the start of the scenario. The lens is that of camera_info; the place of the camera on
// the robot that of /tf_static if a transform from the robot to the frame of the images is there, else that
// of the scenario; it must look straight ahead. As in the job, the robot finds its way by dead reckoning from
// its commands and by tags; odometry is not used. Images may come `latency` late. In the closed loop the
// mission begins with the first image; in the open loop it needs none. States: waiting, driving, done,
// unconfirmed, doubtful, lost, stuck.
#pragma once

#include <optional>

#include "outrider/jobs/drive/mission.hpp"
#include "outrider/log/motion_messages.hpp"
#include "outrider/nodes/mission_node.hpp"
#include "outrider/nodes/tag_sight.hpp"

namespace outrider {

struct DriveMissionNodeOptions {
  MissionNodeOptions node;
  double latency_s = 0.15;  ///< longest time from an exposure until its image has come
  DriveTask task;
};

class DriveMissionNode final : public MissionNode {
 public:
  explicit DriveMissionNode(DriveMissionNodeOptions options);
  [[nodiscard]] const std::optional<DriveMission>& mission() const { return mission_; }

 private:
  template <class Message>
  Status take_sight(const Message& message);
  void act() override;
  Status mount();
  void start();
  [[nodiscard]] Observation observation() const;
  void note();
  void note_arrival(const DriveArrival& arrival);
  void finish();

  DriveTask task_;
  RobotFrames places_;
  TagSight sight_;
  std::string camera_frame_;
  std::optional<DriveMission> mission_;
  outrider_msgs::Waypoints waypoints_;  ///< as they are logged
  Twist2 twist_;                        ///< of the newest command
  double until_s_ = 0.0;
  double noted_s_ = -1e9;  ///< when the belief was logged
  std::int64_t used_ = 0;
  std::size_t arrivals_ = 0;
  std::size_t relocalisations_ = 0;
};

}  // namespace outrider
