// FollowerNode: drives a robot along a path and stops it in time.
//
//   plan  nav_msgs/Path            ->   cmd_vel          geometry_msgs/TwistStamped, or Twist
//   odom  nav_msgs/Odometry             follower/status  driving, arrived, waiting or stopped, and why
//   scan  sensor_msgs/LaserScan
//   map   nav_msgs/OccupancyGrid
//   /tf, /tf_static
//
// The controller is control/steer.hpp: no command is given whose motion, with braking, comes nearer to what
// the newest scan or the map shows than `steer.least_gap`. The motion begins where the robot will be once it
// obeys: its newest odometry, moved on by the commands given since.
//
// The robot stops, and the status says why, if the newest odometry, scan, or transform from the map to the
// odometry came more than its patience ago; the patience and one period are less than 0.5 s. The patience
// with the map itself has no limit by default, since a saved map comes once. A robot that something stops
// goes back a little. It stops at the end of the path, and turns to the heading of its last pose. While it
// stands, commands to stand are sent for 2 s only, so that others may drive.
#pragma once

#include <deque>
#include <optional>

#include "outrider/control/steer.hpp"
#include "outrider/nodes/messages/checked.hpp"
#include "outrider/nodes/node.hpp"
#include "outrider/nodes/robot_frames.hpp"
#include "outrider/nodes/scan_points.hpp"

namespace outrider {

struct FollowerNodeOptions {
  FrameNames frames;
  bool plain_twist = false;      ///< commands are Twist, not TwistStamped
  double odom_patience_s = 0.4;  ///< age of the odometry at which it stops
  double scan_patience_s = 0.4;
  double pose_patience_s = 0.4;  ///< of the transform from the map to the odometry
  double map_patience_s = 0.0;   ///< 0: a map never becomes too old
  double reaction_s = 0.1;       ///< from a command until the robot obeys
  double turn_within_rad = 0.1;  ///< of the last heading of a path
  RobotModel robot;
  SteerOptions steer;

  FollowerNodeOptions();
};
std::vector<OptionGroup> describe(FollowerNodeOptions& options);

class FollowerNode final : public Node {
 public:
  explicit FollowerNode(FollowerNodeOptions options);

 private:
  struct Command {
    double time_s = 0.0;
    Twist2 twist;
  };

  Status take_plan(const nav_msgs::Path& path);
  Status take_odometry(const nav_msgs::Odometry& odometry);
  Status take_map(const nav_msgs::OccupancyGrid& map);
  void act() override;
  [[nodiscard]] std::string why_to_stop() const;
  void drive();
  [[nodiscard]] std::pair<Pose2, Twist2> predicted() const;
  [[nodiscard]] Nearby obstacles(const Pose2& map_T_robot) const;
  void note_trail(Vec2 at);
  [[nodiscard]] Twist2 steer_back(const Pose2& pose, const Twist2& now, const Nearby& nearby) const;
  void command(const Twist2& twist);
  void stand();

  FollowerNodeOptions options_;
  RobotFrames frames_;
  NewestStamp plans_, odometries_, maps_;
  MapBeginning beginning_;
  std::optional<double> odometry_came_s_, map_came_s_;
  Pose2 odometry_;
  Twist2 twist_;  ///< at the time of that odometry
  ScanPoints scan_;
  Grid<std::uint8_t> map_;
  std::optional<PathProgress> path_;
  double last_heading_rad_ = 0.0;
  std::deque<Command> commands_;  ///< of the last seconds
  double driven_s_ = -1e9;        ///< when it last gave a command to move
  double moved_on_s_ = 0.0;       ///< when it last got on along the path
  std::deque<Vec2> trail_;        ///< where it came from, on the odometry
  Vec2 stood_;                    ///< where it last got on, on the odometry
  double backs_until_s_ = -1e9;
  std::size_t command_output_;
};

}  // namespace outrider
