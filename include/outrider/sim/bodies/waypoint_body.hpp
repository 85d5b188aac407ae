// WaypointBody: a disk robot that turns in place and drives straight, under trapezoidal speed profiles.
//
// It follows the profiles exactly, but ends with an error of position and heading, drawn from its own random
// stream. On terrain it drives along the surface. There is no collision check: commanded paths must be free
// of obstacles. Only what holds it up (way_faults.hpp) ends a drive before its goal.
#pragma once

#include <algorithm>
#include <functional>
#include <vector>

#include "outrider/motion/robot_model.hpp"
#include "outrider/robot/command.hpp"
#include "outrider/sim/faults/execution_errors.hpp"
#include "outrider/sim/faults/way_faults.hpp"

namespace outrider {

/// The ground on which the body drives.
struct BodyGround {
  const CollisionMap& ground;  ///< obstacles
  const ShotRules& rules;      ///< holds the terrain, if there is one
};

/// A straight leg that the robot drives now.
struct StraightDrive {
  Vec2 from;
  Vec2 goal;
  double length_m = 0.0;
  double begin_s = 0.0;  ///< time at which the leg begins
  double total_s = 0.0;  ///< duration of the leg
};

class WaypointBody {
 public:
  /// Ground and rules must outlive the body.
  WaypointBody(const RobotModel& robot, const BodyGround& on, const Pose2& start,
               const ExecutionErrors& errors, const Rng& rng, const WayFaults& faults = {});

  /// Returns the waypoints that the robot really drives: the last one has a random error. Draws the errors of
  /// position and heading.
  std::vector<Vec2> displaced_waypoints(std::vector<Vec2> waypoints);
  /// Turns in place. Calls `sample` ten times per second and at the end.
  void turn_to(double heading_rad, const std::function<void()>& sample);
  /// Turns towards the goal and returns the leg to it. Its `length_m` is 0 if the robot is at the goal
  /// already.
  StraightDrive begin_straight(Vec2 goal, const std::function<void()>& sample);
  /// Sets the body to its state `after_s` after the beginning of the leg.
  void be_on(const StraightDrive& drive, double after_s);
  /// Returns the position and the velocity `after_s` after the beginning of the leg.
  [[nodiscard]] Platform platform_on(const StraightDrive& drive, double after_s) const;
  /// Returns how long after the beginning of the leg the robot is stopped; nothing if it gets to its goal.
  std::optional<double> stopped_after_s(const StraightDrive& drive);
  /// Completes the leg: the robot is at its goal.
  void end_straight(const StraightDrive& drive);
  /// Ends the leg and the drive after that time. The robot gives the rest of the drive up.
  void cut_short(const StraightDrive& drive, double after_s);
  /// Begins a drive along waypoints. `stopped` says whether it has ended before its last waypoint.
  void begin_way() { stopped_ = false; }
  [[nodiscard]] bool stopped() const { return stopped_; }
  /// Ends the drive along all waypoints: applies the error of the heading.
  void end_way();
  void wait_until(double time_s) { time_s_ = time_s; }
  /// Lets what is due befall the robot: it may be put elsewhere. Returns true if it was.
  bool suffer();
  [[nodiscard]] const Hindrance& hindrance() const { return hindrance_; }

  /// Returns the present time: SimulatedRobot carries out FollowWaypoints itself, and other commands take no
  /// time of the body.
  double begin(const Command&) const { return time_s_; }
  void run_until(double time_s) { time_s_ = std::max(time_s_, time_s); }

  [[nodiscard]] double time_s() const { return time_s_; }
  [[nodiscard]] const Pose2& pose() const { return pose_; }  ///< world_T_robot; heading wrapped
  [[nodiscard]] double driven_m() const { return driven_m_; }
  [[nodiscard]] double turned_rad() const { return turned_rad_; }
  [[nodiscard]] Twist2 twist() const { return {}; }  ///< at rest between two commands
  [[nodiscard]] double position_error_m() const { return errors_.position_m; }
  [[nodiscard]] Stance stance() const { return stance_at(on_.rules, pose_.position); }
  /// Returns the stance `after_s` after the beginning of the leg from one place to another.
  [[nodiscard]] Stance stance_on(Vec2 from, Vec2 to, double after_s) const;

 private:
  RobotModel robot_;
  BodyGround on_;
  ExecutionErrors errors_;
  Rng rng_;
  double time_s_ = 0.0;
  Pose2 pose_;
  double heading_error_rad_ = 0.0;  // error at the end of the present drive
  double driven_m_ = 0.0;
  double turned_rad_ = 0.0;
  Hindrance hindrance_;
  bool stopped_ = false;

  void give_up_way();
  /// Returns the point that distance along the leg, on the ground.
  [[nodiscard]] Vec2 point_on(const StraightDrive& drive, double way_m) const;
};

}  // namespace outrider
