// TwistBody: a robot on two wheels that follows twists, with a bumper.
//
// Every 5 ms its twist comes nearer to the commanded one, as fast as its accelerations allow, within its
// limits of speed. Its disk is swept exactly along the way of each step against all that stands between what
// its wheels climb and its top: where it would touch, it stays where it is and only turns, while its wheels
// slip and count on. A touch counts once until the robot has left what it touched. The odometry adds up the
// turns of the wheels, each with its error of scale and noise that grows with the root of the way.
//
// Same world, start, model, stream of random numbers and commands: same motion. O(obstacles near) a step.
#pragma once

#include <cstdint>

#include "outrider/core/rng.hpp"
#include "outrider/robot/command.hpp"
#include "outrider/sim/open_ground.hpp"

namespace outrider {

class TwistBody {
 public:
  TwistBody(const World& world, const Pose2& start, const RobotModel& robot, const ExplorerWheels& wheels,
            const Rng& wheel_rng);

  /// Begins to carry out a DriveTwist, and returns when it is done; other commands are done at once.
  double begin(const Command& command);
  void run_until(double time_s);
  /// Returns true if the bumper was pressed since the call before.
  bool take_touch();

  [[nodiscard]] double time_s() const { return time_s_; }
  [[nodiscard]] const Pose2& pose() const { return pose_; }          ///< world_T_robot; heading not wrapped
  [[nodiscard]] const Twist2& twist() const { return twist_; }       ///< now, slip left out
  [[nodiscard]] const Pose2& odometry() const { return odometry_; }  ///< start_T_robot by the wheels
  [[nodiscard]] std::int64_t contacts() const { return contacts_; }
  [[nodiscard]] double driven_m() const { return driven_m_; }
  [[nodiscard]] double turned_rad() const { return turned_rad_; }
  [[nodiscard]] const OpenGround& ground() const { return ground_; }

 private:
  void pass(double duration_s);
  void speed_up(double duration_s);
  void count_wheels(double duration_s);
  double counted_m(double way_m, double scale);

  RobotModel robot_;
  ExplorerWheels wheels_;
  OpenGround ground_;
  Rng wheel_rng_;
  double left_scale_ = 1.0;  // of the way that each wheel counts
  double right_scale_ = 1.0;
  double time_s_ = 0.0;
  Pose2 pose_;
  Twist2 wanted_;
  Twist2 twist_;
  Pose2 odometry_;
  bool touching_ = false;  // now
  bool touched_ = false;   // since the last take_touch()
  std::int64_t contacts_ = 0;
  double driven_m_ = 0.0;
  double turned_rad_ = 0.0;
};

}  // namespace outrider
