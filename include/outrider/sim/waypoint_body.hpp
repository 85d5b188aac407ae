// WaypointBody: a disk robot that turns in place and drives straight, under trapezoidal speed profiles.
//
// It follows the profiles exactly, and ends a little off: the errors of place and heading are drawn from a
// stream of their own. On terrain it drives along the surface. Nothing stops it on the way: ways are
// commanded clear of obstacles.
#pragma once

#include <algorithm>
#include <functional>
#include <vector>

#include "outrider/motion/robot_model.hpp"
#include "outrider/robot/command.hpp"
#include "outrider/sim/execution_errors.hpp"

namespace outrider {

/// What the body drives on.
struct BodyGround {
  const CollisionMap& ground;  ///< for the disk of the robot
  const ShotRules& rules;      ///< with the terrain, where there is one
};

/// A straight under way.
struct StraightDrive {
  Vec2 from;
  Vec2 goal;
  double length_m = 0.0;
  double begin_s = 0.0;
  double total_s = 0.0;
};

class WaypointBody {
 public:
  /// Ground and rules must outlive the body.
  WaypointBody(const RobotModel& robot, const BodyGround& on, const Pose2& start,
               const ExecutionErrors& errors, const Rng& rng);

  /// The way that it will really go: it ends a little off the last waypoint. Draws the errors.
  std::vector<Vec2> strayed_way(std::vector<Vec2> waypoints);
  /// Turns in place. `sample` is called ten times a second, and at the end.
  void turn_to(double heading_rad, const std::function<void()>& sample);
  /// Turns, then is at the beginning of the straight; `length_m` is 0 where it stands at the goal.
  StraightDrive begin_straight(Vec2 goal, const std::function<void()>& sample);
  /// Is where the profile has it that long after the beginning.
  void be_on(const StraightDrive& drive, double after_s);
  /// The velocity over the ground then.
  [[nodiscard]] Vec2 velocity_on(const StraightDrive& drive, double after_s) const;
  void end_straight(const StraightDrive& drive);
  /// The way is over: the heading is off.
  void end_way();
  void wait_until(double time_s) { time_s_ = time_s; }

  /// Other commands than those to drive to waypoints take no time of the body.
  double begin(const Command&) const { return time_s_; }
  void run_until(double time_s) { time_s_ = std::max(time_s_, time_s); }

  [[nodiscard]] double time_s() const { return time_s_; }
  [[nodiscard]] const Pose2& pose() const { return pose_; }  ///< world_T_robot; heading wrapped
  [[nodiscard]] double driven_m() const { return driven_m_; }
  [[nodiscard]] double turned_rad() const { return turned_rad_; }
  [[nodiscard]] Twist2 twist() const { return {}; }  ///< at rest between two commands
  [[nodiscard]] double position_error_m() const { return errors_.position_m; }
  [[nodiscard]] Stance stance() const { return stance_at(on_.rules, pose_.position); }

 private:
  RobotModel robot_;
  BodyGround on_;
  ExecutionErrors errors_;
  Rng rng_;
  double time_s_ = 0.0;
  Pose2 pose_;
  double heading_error_rad_ = 0.0;  // of the way under way
  double driven_m_ = 0.0;
  double turned_rad_ = 0.0;
};

}  // namespace outrider
