// MapperNode: makes a map of laser scans and says where the robot is on it (slam/laser_slam.hpp).
//
//   scan   sensor_msgs/LaserScan    ->   map   nav_msgs/OccupancyGrid, latched, once in map_period
//   odom   nav_msgs/Odometry             pose  geometry_msgs/PoseWithCovarianceStamped, at each scan
//   /tf, /tf_static                      /tf   map -> odom, at each tick
//
// The map begins where the odometry says that the robot is at the first scan; its load time is that of this
// scan, so that others notice when a mapper is started anew and places on the map before hold no more. Where
// the laser stands on the robot comes from /tf and /tf_static; the scans wait for it, and for the odometry of
// their time. While no scan comes, map -> odom is not sent, so that others notice.
#pragma once

#include <deque>
#include <optional>

#include "outrider/log/ros_sensor_messages.hpp"
#include "outrider/nodes/checked.hpp"
#include "outrider/nodes/node.hpp"
#include "outrider/nodes/robot_frames.hpp"
#include "outrider/slam/laser_slam.hpp"

namespace outrider {

struct MapperNodeOptions {
  FrameNames frames;
  double map_period_s = 1.0;  ///< the map is sent at most so often
  double patience_s = 1.0;    ///< time without a scan after which it no longer says where the robot is
  LaserSlamOptions slam;      ///< its mount comes from the transforms

  MapperNodeOptions();
};
std::vector<OptionGroup> describe(MapperNodeOptions& options);

class MapperNode final : public Node {
 public:
  explicit MapperNode(MapperNodeOptions options);

 private:
  struct Waiting {
    double time_s = 0.0;
    sensor_msgs::LaserScan scan;
  };

  Status take_scan(const sensor_msgs::LaserScan& scan);
  Status take_odometry(const nav_msgs::Odometry& odometry);
  void act() override;
  void map_waiting();
  Status map(const Waiting& waiting);
  void send_pose(double time_s);
  void send_map();

  MapperNodeOptions options_;
  RobotFrames frames_;
  NewestStamp scans_, odometries_;
  std::deque<Waiting> waiting_;
  std::optional<LaserSlam> slam_;
  Pose2 odometry_;  ///< at the last scan that was mapped
  Pose2 map_T_odom_;
  std::optional<double> mapped_s_;  ///< when it was mapped
  double map_sent_s_ = -1e9;
  double begun_s_ = 0.0;  ///< time of the first scan that was mapped
  bool map_changed_ = false;
  std::size_t map_output_, pose_output_, transform_output_;
};

}  // namespace outrider
