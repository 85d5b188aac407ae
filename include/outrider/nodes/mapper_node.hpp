// MapperNode: makes a map of laser scans and says where the robot is on it (slam/laser/laser_slam.hpp).
//
//   scan   sensor_msgs/LaserScan    ->   map   nav_msgs/OccupancyGrid, latched, once in map_period
//   odom   nav_msgs/Odometry             pose  geometry_msgs/PoseWithCovarianceStamped, at each scan
//   /tf, /tf_static                      /tf   map -> odom, at each tick
//
// The map begins where the odometry says that the robot is at the first scan; its load time is that of this
// scan, so that others notice when a mapper is started anew and places on the map before hold no more. The
// pose of the laser on the robot comes from /tf and /tf_static; the scans wait for it, and for the odometry
// of their time. While no scan comes, map -> odom is not sent, so that others notice.
//
// Each time the robot stands after it drove, and when the scans have become half as many again, the mapper
// asks whether its map can be believed (jobs/explore/map/map_doubt.hpp); as long as it cannot, its status is
// doubtful.
//
// With `keep` the map is kept in files, and a mapper that is started anew goes on with it, with the same load
// time, if its first scan fits where the odometry says that the robot is (nodes/kept_map.hpp): so if the
// robot and its odometry went on meanwhile. Otherwise it begins another map and says so. It maps the scans
// that were kept once more, so loops close between what was mapped before and after. Areas that only other
// scans showed before stay as they are where nothing new is seen, until a loop moves the map.
#pragma once

#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "outrider/log/messages/ros_sensor_messages.hpp"
#include "outrider/nodes/kept_map.hpp"
#include "outrider/nodes/messages/checked.hpp"
#include "outrider/nodes/node.hpp"
#include "outrider/nodes/robot_frames.hpp"
#include "outrider/slam/laser/laser_slam.hpp"

namespace outrider {

struct MapperNodeOptions {
  FrameNames frames;
  double map_period_s = 1.0;   ///< the map is sent at most so often
  double patience_s = 1.0;     ///< time without a scan after which it no longer says where the robot is
  std::string keep;            ///< YAML file in which the map is kept; empty: it is not kept
  double keep_period_s = 2.0;  ///< the files are written at most so often
  LaserSlamOptions slam;       ///< its mount comes from the transforms

  MapperNodeOptions();
};
std::vector<OptionGroup> describe(MapperNodeOptions& options);

class MapperNode final : public Node {
 public:
  /// Fault: bad_input for a kept map that cannot be read, or whose cells have another size.
  static Outcome<MapperNodeOptions> checked(MapperNodeOptions options);
  explicit MapperNode(MapperNodeOptions options);

  /// The SLAM; null before the first scan. Its first `replayed_steps()` steps are those of scans that were
  /// kept.
  [[nodiscard]] const LaserSlam* slam() const { return slam_ ? &*slam_ : nullptr; }
  [[nodiscard]] std::size_t replayed_steps() const { return kept_ ? kept_->scans.size() : 0; }

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
  void judge();
  Status begin(const Pose2& odometry, const LaserScan& scan, double time_s);
  Status go_on(const Pose2& place, const Pose2& odometry);
  Outcome<LaserSlamStep> advance(const Pose2& motion, const LaserScan& scan);
  [[nodiscard]] std::vector<KeptScan> kept_scans() const;

  MapperNodeOptions options_;
  RobotFrames frames_;
  NewestStamp scans_, odometries_;
  std::deque<Waiting> waiting_;
  std::optional<LaserSlam> slam_;
  Pose2 odometry_;  ///< at the last scan that was mapped
  Pose2 map_T_odom_;
  std::optional<double> mapped_s_;  ///< when it was mapped
  double map_sent_s_ = -1e9;
  double begun_s_ = 0.0;                                      ///< time of the first scan that was mapped
  std::optional<KeptMap> kept_;                               ///< of the mapper before
  double kept_s_ = -1e9;                                      ///< when the files were written
  std::size_t steps_ = 0;                                     ///< of the SLAM
  std::vector<std::pair<std::size_t, LaserScan>> keyframes_;  ///< steps and scans, if the map is kept
  bool map_changed_ = false;
  double drove_s_ = 0.0;          ///< when a scan was mapped from elsewhere than the one before
  bool judged_ = true;            ///< the robot has not driven since the map was judged
  std::size_t judged_steps_ = 0;  ///< of the SLAM, at that time
  std::string doubt_;             ///< why the map cannot be believed
  std::size_t map_output_, pose_output_, transform_output_;
};

}  // namespace outrider
