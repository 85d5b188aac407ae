// ExploreMissionNode: the whole mission of the job explore (jobs/explore/mission/mission.hpp) as one node,
// with its robot on the other side of topics.
//
//   scan  sensor_msgs/LaserScan    ->   cmd_vel         geometry_msgs/TwistStamped, or Twist
//   odom  nav_msgs/Odometry             /tf             map -> odom
//   /tf, /tf_static                     explore/status  what it does, and why it ended
//                                       the channels of the run: map, map_updates, pose, belief, plan, ...
//
// The pose of the run is that in which the robot believes, since nobody tells the true one. Beside the maps
// that are logged, whole ones are sent on map, so that who comes late has all of it.
//
// Unlike mapper, explorer, planner and follower together, it passes narrow ways, and it does not foresee late
// messages: it is for a robot on the same machine. It stands still while the newest odometry or scan is older
// than its patience, and says so. The map begins where the robot is at the first scan.
#pragma once

#include <optional>

#include "outrider/jobs/explore/mission/explore_log.hpp"
#include "outrider/log/messages/ros_sensor_messages.hpp"
#include "outrider/log/messages/scene_messages.hpp"
#include "outrider/nodes/missions/mission_node.hpp"

namespace outrider {

struct ExploreMissionNodeOptions {
  MissionNodeOptions node;
  double map_period_s = 1.0;  ///< whole maps are sent at most so often
  ExploreTask task;           ///< its start and mount come from the messages
};

class ExploreMissionNode final : public MissionNode {
 public:
  explicit ExploreMissionNode(ExploreMissionNodeOptions options);

 private:
  Status take_scan(const sensor_msgs::LaserScan& scan);
  void odometry_came() override { perceive_waiting(); }
  void act() override;
  Status start(const Pose2& robot_T_laser);
  void perceive_waiting();
  void perceive_at(double time_s, std::optional<LaserScan> scan);
  [[nodiscard]] std::string why_to_stop() const;
  void drive();
  void finish();
  void publish();

  double map_period_s_;
  ExploreTask task_;
  NewestStamp scans_;
  std::optional<double> scan_came_s_;
  std::optional<sensor_msgs::LaserScan> waiting_;  ///< the newest scan that was not seen yet
  std::optional<ExploreMission> mission_;
  std::optional<ExploreLog> run_log_;
  outrider_msgs::RunInfo info_;
  double seen_s_ = 0.0;  ///< time of the newest observation
  double map_sent_s_ = -1e9;
  std::size_t transform_output_;
};

}  // namespace outrider
