// ExploreMissionNode: the whole mission of the job explore (jobs/explore/mission.hpp) as one node, with its
// robot on the other side of topics.
//
//   scan  sensor_msgs/LaserScan    ->   cmd_vel         geometry_msgs/TwistStamped, or Twist
//   odom  nav_msgs/Odometry             map, pose, /tf  as MapperNode sends them
//   /tf, /tf_static                     goal_pose, plan what the mission goes for
//                                       explore/status  what it does, and why it ended
//
// Unlike mapper, explorer, planner and follower together, it passes narrow ways, and it does not foresee late
// messages: it is for a robot on the same machine. It stands still while the newest odometry or scan is older
// than its patience, and says so. The map begins where the robot is at the first scan.
#pragma once

#include <optional>

#include "outrider/jobs/explore/mission.hpp"
#include "outrider/log/ros_sensor_messages.hpp"
#include "outrider/nodes/checked.hpp"
#include "outrider/nodes/node.hpp"
#include "outrider/nodes/robot_frames.hpp"

namespace outrider {

struct ExploreMissionNodeOptions {
  FrameNames frames;
  bool plain_twist = false;   ///< commands are Twist, not TwistStamped
  double patience_s = 0.4;    ///< age of odometry or scan at which it stands still
  double map_period_s = 1.0;  ///< the map is sent at most so often
  ExploreTask task;           ///< its start and mount come from the messages
};

class ExploreMissionNode final : public Node {
 public:
  explicit ExploreMissionNode(ExploreMissionNodeOptions options);
  [[nodiscard]] bool is_over() const override { return over_; }

 private:
  Status take_scan(const sensor_msgs::LaserScan& scan);
  Status take_odometry(const nav_msgs::Odometry& odometry);
  void act() override;
  Status start(const Pose2& robot_T_laser);
  void perceive_waiting();
  void perceive_at(double time_s, std::optional<LaserScan> scan);
  [[nodiscard]] std::string why_to_stop() const;
  void drive();
  void publish();
  void command(const Twist2& twist);

  ExploreMissionNodeOptions options_;
  RobotFrames frames_;
  NewestStamp scans_, odometries_;
  std::optional<double> scan_came_s_, odometry_came_s_;
  std::optional<sensor_msgs::LaserScan> waiting_;  ///< the newest scan that was not seen yet
  std::optional<ExploreMission> mission_;
  double seen_s_ = 0.0;  ///< time of the newest observation
  double map_sent_s_ = -1e9;
  std::size_t goal_changes_ = 0;
  bool over_ = false;
  std::size_t command_output_, map_output_, pose_output_, transform_output_, goal_output_, plan_output_;
};

}  // namespace outrider
