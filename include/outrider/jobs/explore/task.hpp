// ExploreTask: what a robot with a range finder knows before it explores, how it chooses where to go and how
// it drives there, and when it gives up.
#pragma once

#include <vector>

#include "outrider/control/steer.hpp"
#include "outrider/jobs/explore/decide.hpp"
#include "outrider/motion/robot_model.hpp"
#include "outrider/slam/laser_slam.hpp"

namespace outrider {

/// A TurtleBot3 burger. Source: ROBOTIS e-Manual, TurtleBot3 features.
RobotModel burger();

/// SLAM with a range finder of a few metres, on wheels that are good but for what they always count wrong.
/// Away from walls it sees nothing and goes by the odometry, which must not be doubted more than it deserves:
/// else the place to which it comes back is sought among too many others like it.
LaserSlamOptions near_sighted_slam();

/// When the executor thinks, waits and gives up.
struct ExploreRules {
  double period_s = 0.05;      ///< of control
  double think_again_s = 1.0;  ///< a goal is thought over at least so often
  double patience_s = 4.0;     ///< without moving on, after which it is stuck
  double back_off_m = 0.2;     ///< how far it then goes back along the way it came
  double blind_s = 1.0;        ///< without a usable scan, after which it stands still; ten times that ends it
  std::int64_t most_stuck = 20;  ///< times that it gets stuck within some way; then it ends
  bool return_home = true;
  double home_within_m = 0.1;    ///< of the start, where it is home
  double most_time_s = 36000.0;  ///< after which it goes home
  double most_distance_m = 1e5;  ///< driven, after which it goes home
  double lost_m = 10.0;          ///< bound of the standard deviation of its position at which it is lost
};
std::vector<Option> describe(ExploreRules& rules);

struct ExploreTask {
  Pose2 start;  ///< world_T_robot, exact
  RobotModel robot = burger();
  LaserSlamOptions slam = near_sighted_slam();
  ExploreOptions explore;
  SteerOptions steer;
  ExploreRules rules;
};

}  // namespace outrider
