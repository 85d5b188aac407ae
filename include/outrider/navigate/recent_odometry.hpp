// RecentOdometry: where a robot was lately by its odometry, in a time that never goes back, and how fast it
// is.
//
// The clock of a robot may be put back: times of the track go on from there. Its twist is believed to be as
// commanded, within its limits, and corrected by what was measured. Thread rule: one at a time.
#pragma once

#include <deque>

#include "outrider/geometry/pose.hpp"
#include "outrider/motion/robot_model.hpp"
#include "outrider/motion/twist.hpp"
#include "outrider/robot/observation.hpp"

namespace outrider {

class RecentOdometry {
 public:
  static constexpr double remembered_s = 1.0;  ///< length of the track, for scans that come late

  /// Notes the odometry and the time of an observation, `period_s` after the one before if the clock was put
  /// back. `commanded` is the twist since then. What makes no sense is not noted. O(1).
  void note(const Observation& seen, const Twist2& commanded, const RobotModel& robot, double period_s);

  [[nodiscard]] bool empty() const { return track_.empty(); }
  /// Returns the present time, and the same by the clock of the robot.
  [[nodiscard]] double time_s() const { return time_s_; }
  [[nodiscard]] double clock_s() const { return time_s_ - ahead_s_; }
  /// Returns the time of the track at a time of the clock.
  [[nodiscard]] double time_of(double clock_s) const { return clock_s + ahead_s_; }
  /// Returns the newest odom_T_robot, and that at a time not long ago; the track may not be empty.
  [[nodiscard]] const Pose2& newest() const { return track_.back().odometry; }
  [[nodiscard]] Pose2 at(double time_s) const;
  [[nodiscard]] const Twist2& twist() const { return twist_; }  ///< present

 private:
  struct TimedOdometry {
    double time_s = 0.0;
    Pose2 odometry;
  };

  double ahead_s_ = 0.0;  // of the clock, which may be put back
  double time_s_ = 0.0;
  std::deque<TimedOdometry> track_;
  Twist2 twist_;
};

}  // namespace outrider
