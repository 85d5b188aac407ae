// TwistBody: a differential-drive robot with a bumper that follows commanded twists.
//
// In steps of 5 ms its twist approaches the commanded twist within the limits of acceleration and speed. In
// each step the disk of the robot is swept exactly along the motion; a footprint, if it has one, is tried
// exactly where the step ends. Obstacles are all solids higher than what the wheels can climb and lower than
// the top of the robot. If the disk would touch one, the robot stays in place and only turns, while its
// wheels slip and the encoders keep counting. A contact counts once until the robot has left the obstacle.
// The odometry integrates the rotations of the wheels, each with its own scale error and with noise that
// grows with the square root of the distance. Of the faults it has slip and a stuck wheel.
//
// The same world, start, model, random stream and commands give the same motion. O(nearby obstacles) per
// step.
#pragma once

#include <cstdint>
#include <optional>

#include "outrider/core/rng.hpp"
#include "outrider/robot/command.hpp"
#include "outrider/sim/open_ground.hpp"

namespace outrider {

class TwistBody {
 public:
  TwistBody(const World& world, const Pose2& start, const RobotModel& robot, const ExplorerWheels& wheels,
            const Rng& wheel_rng, const ExplorerFaults& faults = {}, const Rng& walk_in_rng = Rng(0),
            std::optional<Footprint> footprint = {});

  /// Begins a DriveTwist and returns its end time; other commands end at once.
  double begin(const Command& command);
  void run_until(double time_s);
  /// Moves the robot to another pose at once (kidnapping), where it stands. Moves it less far if it would
  /// be nearer than 0.1 m to an obstacle there.
  void put(const Pose2& pose);
  /// Returns true if the bumper was pressed since the previous call.
  bool take_touch();
  /// Returns the bearing of the newest contact relative to the heading, if there was one.
  [[nodiscard]] std::optional<double> touch_rad() const { return touch_rad_; }

  [[nodiscard]] double time_s() const { return time_s_; }
  [[nodiscard]] const Pose2& pose() const { return pose_; }     ///< world_T_robot; heading not wrapped
  [[nodiscard]] const Twist2& twist() const { return twist_; }  ///< present twist, without slip
  /// Returns start_T_robot as the wheels measure it, or as it is.
  [[nodiscard]] Pose2 odometry() const { return wheels_.exact ? relative_pose(start_, pose_) : odometry_; }
  [[nodiscard]] std::int64_t contacts() const { return contacts_; }
  /// Returns how often somebody walked into the robot, whose motion did not bring it nearer to them, or which
  /// was commanded to stand or to turn in place and came nearer more slowly than they did.
  [[nodiscard]] std::int64_t walked_into() const { return walked_into_; }
  [[nodiscard]] double driven_m() const { return driven_m_; }
  [[nodiscard]] double turned_rad() const { return turned_rad_; }
  [[nodiscard]] const OpenGround& ground() const { return ground_; }
  [[nodiscard]] const WalkIns& walk_ins() const { return walk_ins_; }

 private:
  void pass(double duration_s);
  [[nodiscard]] bool free(Segment way) const;
  [[nodiscard]] double room_m(const Pose2& pose) const;
  [[nodiscard]] double moving_room_m(const Pose2& pose) const;
  void stop_at_contact(Pose2& next);
  [[nodiscard]] bool is_walked_into(const Pose2& next) const;
  [[nodiscard]] double towards_nearest(Vec2 centre) const;
  [[nodiscard]] Twist2 rolled() const;
  void count_wheels(const Twist2& rolled, double duration_s);
  double counted_m(double way_m, double scale);

  RobotModel robot_;
  ExplorerWheels wheels_;
  ExplorerFaults faults_;
  std::optional<Footprint> footprint_;
  OpenGround ground_;
  WalkIns walk_ins_;
  Rng wheel_rng_;
  double left_scale_ = 1.0;  // scale of the distance counted by each wheel
  double right_scale_ = 1.0;
  double time_s_ = 0.0;
  Pose2 start_;
  Pose2 pose_;
  Twist2 wanted_;
  Twist2 twist_;
  Pose2 odometry_;
  double moving_room_m_ = 0.0;  // when the last step ended
  bool touching_ = false;       // now
  bool touched_ = false;        // since the last take_touch()
  std::optional<double> touch_rad_;
  std::int64_t contacts_ = 0;
  std::int64_t walked_into_ = 0;
  double driven_m_ = 0.0;
  double turned_rad_ = 0.0;
};

}  // namespace outrider
