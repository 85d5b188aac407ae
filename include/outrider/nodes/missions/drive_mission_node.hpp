// DriveMissionNode: the mission of the job drive (jobs/drive/mission/mission.hpp) with its robot behind
// topics.
//
//   camera/camera_info                 ->   cmd_vel; sideways too for mecanum and holonomic robots
//   camera/image_raw, or detections         drive/status  what it does, and which stops are confirmed
//   scan: what is in the way, if it comes   the channels of the run: /waypoints, /tags, /belief, ...
//   /tf_static: the place of camera and laser
//
// The robot stands at the start of the scenario. The lens is that of camera_info; the place of the camera on
// the robot that of /tf_static if a transform from the robot to the frame of the images is there, else that
// of the scenario; it must look straight ahead. As in the job, the robot finds its way by dead reckoning from
// its commands and by tags; odometry is not used. Images may come `latency` late. In the closed loop the
// mission begins with the first image; in the open loop it needs none.
//
// If the newest scan shows something in the way (in_the_way.hpp) that is more than 0.1 m away from every
// solid of the world, or no scan comes any more, the robot slows down and stops. The time of the mission then
// slows down and stops too (slowed_clock.hpp), so the robot drives the same path later. States: waiting,
// driving, stopped, done, unconfirmed, doubtful, lost, stuck, blocked.
#pragma once

#include <deque>
#include <optional>
#include <utility>
#include <vector>

#include "outrider/jobs/drive/mission/mission.hpp"
#include "outrider/log/messages/motion_messages.hpp"
#include "outrider/nodes/missions/mission_node.hpp"
#include "outrider/nodes/missions/slowed_clock.hpp"
#include "outrider/nodes/missions/tag_sight.hpp"
#include "outrider/sim/sensors/range_finder.hpp"

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
  [[nodiscard]] std::optional<Vec2> thing_ahead();
  void note_unmapped();
  [[nodiscard]] Pose2 moved_since(double time_s) const;
  void drive(double rate);
  void note();
  void note_arrival(const DriveArrival& arrival);
  void finish();

  DriveTask task_;
  TagSight sight_;
  std::string camera_frame_;
  std::optional<DriveMission> mission_;
  outrider_msgs::Waypoints waypoints_;  ///< as they are logged
  Twist2 twist_;                        ///< that the mission wants
  double until_s_ = 0.0;                ///< by the clock of the mission
  SlowedClock clock_;
  std::optional<RangeFinder> solids_;  ///< what is on the map
  std::vector<Vec2>
      unmapped_;              ///< what the newest scan shows beside it, in the frame of the robot at its time
  double unmapped_s_ = -1.0;  ///< time of that scan
  std::deque<std::pair<double, Twist2>> sent_;  ///< commands of the last seconds, and their times
  double noted_s_ = -1e9;                       ///< when the belief was logged
  std::int64_t used_ = 0;
  std::size_t arrivals_ = 0;
  std::size_t relocalisations_ = 0;
};

}  // namespace outrider
