#include "outrider/jobs/explore/mission/task.hpp"

namespace outrider {

RobotModel burger() {
  RobotModel robot;
  robot.radius_m = 0.105;
  robot.height_m = 0.192;
  robot.speed_mps = 0.22;
  robot.acceleration_mps2 = 2.5;
  robot.turn_rate_radps = 2.84;
  robot.turn_acceleration_radps2 = 3.2;
  return robot;
}

LaserSlamOptions near_sighted_slam() {
  LaserSlamOptions slam;
  slam.key_distance_m = 0.5;
  slam.learn_odometry = true;
  slam.loop_reach_sd = 5.0;  // simulated sensors err as stated
  // The error that is left once the constant scale error of the wheels is estimated.
  slam.odometry_distance = 0.02;
  slam.odometry_turn = 0.02;
  slam.odometry_turn_per_distance_rad = 0.03;
  // Beams that graze a wall pass through many of its cells for each one that they end in.
  slam.map.hit_odds = 1.5;
  slam.map.miss_odds = 0.3;
  return slam;
}

NavigatorOptions patient() {
  NavigatorOptions options;
  options.plan_again_s = 0.5;
  options.most_recoveries = 3;
  options.blind_s = 1.0;
  return options;
}

LiveMapOptions near_sighted_map() {
  LiveMapOptions options;
  options.reach_m = 4.0;
  options.touch_s = 1e6;
  return options;
}

LocalMotionOptions careful_motion() {
  LocalMotionOptions options;
  options.margin_m = 0.01;
  options.samples = 36;
  options.horizon_s = 1.6;
  options.rounds = 1;
  options.wide_m = 0.1;
  return options;
}

std::vector<Option> describe(ExploreRules& rules) {
  return {
      {"period", "s", 0.005, 1.0, "of control", &rules.period_s},
      {"think_again", "s", 0.0, 3600.0, "a goal is thought over at least so often", &rules.think_again_s},
      {"patience", "s", 0.5, 3600.0, "without moving on, after which it is stuck", &rules.patience_s},
      {"blind", "s", 0.01, 3600.0,
       "without a usable scan, after which it stands still; ten times that ends it", &rules.blind_s},
      {"most_stuck", "", 0, 100000, "times that it gets stuck with less than 20 m between; then it ends",
       &rules.most_stuck},
      {"return_home", "", 0, 0, "it comes back to where it started", &rules.return_home},
      {"home_within", "m", 0.02, 100.0, "of the start, where it is home", &rules.home_within_m},
      {"most_time", "s", 0.0, 1e9, "after which it goes home", &rules.most_time_s},
      {"most_distance", "m", 0.0, 1e9, "driven, after which it goes home", &rules.most_distance_m},
      {"lost", "m", 1e-3, 1e3, "bound of the standard deviation of its position at which it is lost",
       &rules.lost_m},
  };
}

}  // namespace outrider
