// ExploreTask: the settings of a robot with a range finder that explores: its model, SLAM, decisions,
// steering and limits.
#pragma once

#include <vector>

#include "outrider/jobs/explore/choose/decide.hpp"
#include "outrider/navigate/navigator.hpp"
#include "outrider/slam/laser/laser_slam.hpp"

namespace outrider {

/// Returns the model of a TurtleBot3 burger. Source: ROBOTIS e-Manual, TurtleBot3 features.
RobotModel burger();

/// Returns SLAM options for a range finder of a few metres and for odometry with a constant scale error per
/// wheel and no other fault. Away from walls the robot depends on odometry. Its assumed uncertainty must not
/// be too large, or loop closure compares too many similar places.
LaserSlamOptions near_sighted_slam();

/// Return options of the navigator for a small slow robot with a range finder of a few metres.
NavigatorOptions patient();
LiveMapOptions near_sighted_map();
LocalMotionOptions careful_motion();

/// When the mission decides again, waits and gives up.
struct ExploreRules {
  double period_s = 0.05;      ///< control period
  double think_again_s = 1.0;  ///< longest time between two decisions
  double patience_s = 4.0;     ///< time without progress after which the robot counts as stuck
  double blind_s =
      1.0;  ///< time without a usable scan after which the robot stops; ten times that ends the mission
  std::int64_t most_stuck = 20;  ///< number of times stuck in a row that ends the mission
  bool return_home = true;       ///< drive home in the end
  double home_within_m = 0.1;    ///< distance from the start within which the robot is home
  double most_time_s = 36000.0;  ///< time after which the robot drives home
  double most_distance_m = 1e5;  ///< driven distance after which the robot drives home
  double lost_m = 10.0;          ///< standard deviation of the position at which the robot is lost
};
/// Describes the options by name.
std::vector<Option> describe(ExploreRules& rules);

/// The settings.
struct ExploreTask {
  Pose2 start;                                  ///< world_T_robot, exact
  RobotModel robot = burger();                  ///< size and speeds
  LaserSlamOptions slam = near_sighted_slam();  ///< of SLAM
  ExploreOptions explore;                       ///< of the decisions
  NavigatorOptions navigator = patient();       ///< the options of its navigator
  LiveMapOptions live_map = near_sighted_map();
  LocalMotionOptions motion = careful_motion();
  ExploreRules rules;  ///< limits
};

}  // namespace outrider
