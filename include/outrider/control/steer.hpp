// Steer: the twist with which a disk robot that turns and goes ahead follows a path on a map it is still
// learning, at full speed wherever it can, without touching what it knows of.
//
// It aims at the farthest point of the path within `lookahead` to which it can go straight with `gap` to
// spare, so that it cuts corners as far as there is room. It drives while it turns, slower the farther it
// has to turn, and turns in place beyond `pivot`. What the command leads to is then foreseen for `foresight`
// with the robot's accelerations; where that comes nearer to an obstacle than `least_gap`, and nearer than
// the robot is now, it goes slower, in the end not ahead at all: a disk that turns touches nothing new.
//
// A pure function; O(cells nearby). Source: Macenski, Singh, Martin and Gines, Regulated pure pursuit for
// robot path tracking (Autonomous Robots, 2023); Fox, Burgard and Thrun, The dynamic window approach to
// collision avoidance (1997).
#pragma once

#include <vector>

#include "outrider/control/nearby.hpp"
#include "outrider/core/options.hpp"
#include "outrider/core/units.hpp"
#include "outrider/motion/robot_model.hpp"
#include "outrider/motion/twist.hpp"

namespace outrider {

struct SteerOptions {
  double lookahead_m = 0.5;
  double gap_m = 0.02;        ///< between the robot and an obstacle, where it takes a short cut
  double least_gap_m = 0.01;  ///< between the robot and an obstacle, anywhere
  double pivot_rad = radians(70.0);
  double settle_s = 0.25;  ///< in which a small error of the heading is turned away
  double foresight_s = 0.5;
};
std::vector<Option> describe(SteerOptions& options);

/// A path being followed.
struct Followed {
  std::vector<Vec2> points;  ///< at least one
  double along_m = 0.0;      ///< of its length, what has been passed; never less than before
};

/// How far along the path the robot has come: the nearest place of the path not far beyond the last.
void pass(Followed& path, Vec2 position);

/// What is left of the path, m.
double left_of(const Followed& path);

/// The command for a robot at that pose with that twist. To rest within 1 cm of the path's end.
Twist2 steer(const Followed& path, const Pose2& pose, const Twist2& now, const Nearby& nearby,
             const RobotModel& robot, const SteerOptions& options);

}  // namespace outrider
