// WheelBody: a robot on wheels and what it really does, with the faults of its wheels and of the link to it.
//
// Steps of 5 ms: the newest command that has arrived gives each wheel its speed, through dead time, deadband
// and lag; gains, sag and noise make of it the speed at which the wheel really turns; the chassis makes of
// all wheels a twist, of which slip takes a part of the sideways motion. The noise of each wheel is a
// first-order Gauss-Markov process. Same seed and commands, same motion. O(wheels) a step.
#pragma once

#include <deque>

#include "outrider/core/rng.hpp"
#include "outrider/motion/wheel_faults.hpp"
#include "outrider/robot/command.hpp"

namespace outrider {

class WheelBody {
 public:
  WheelBody(Chassis chassis, const WheelFaults& faults, const LinkFaults& link, const Pose2& start,
            const Rng& rng);

  /// Gives a command to the link, now.
  void send(const WheelSpeeds4& wheels);
  /// Begins to carry out a DriveWheels, and returns when it is done; other commands are done at once.
  double begin(const Command& command);
  /// Lets time pass, by whole steps and what is left of one.
  void run_until(double time_s);
  /// Puts the robot elsewhere.
  void put(const Pose2& pose) { pose_ = pose; }

  [[nodiscard]] double time_s() const { return time_s_; }
  [[nodiscard]] const Pose2& pose() const { return pose_; }     ///< heading not wrapped
  [[nodiscard]] const Twist2& twist() const { return twist_; }  ///< in the last step
  [[nodiscard]] double driven_m() const { return driven_m_; }
  [[nodiscard]] double turned_rad() const { return turned_rad_; }

 private:
  struct Message {
    double arrives_s = 0.0;
    WheelSpeeds4 wheels{};
  };

  void pass(double duration_s);
  double turn_wheel(std::size_t wheel, double duration_s);

  Chassis chassis_;
  WheelFaults faults_;
  LinkFaults link_;
  Rng wheel_rng_;
  Rng link_rng_;
  double time_s_ = 0.0;
  Pose2 pose_;
  Twist2 twist_;
  double driven_m_ = 0.0;
  double turned_rad_ = 0.0;
  double moving_s_ = 0.0;         // time driven so far: what the battery has given
  std::int64_t sent_ = 0;         // messages
  std::deque<Message> messages_;  // under way
  WheelSpeeds4 commanded_{};      // by the newest message that has arrived
  WheelSpeeds4 followed_{};       // what the lag has made of it
  WheelSpeeds4 noise_{};          // relative
  WheelSpeeds4 waited_s_{};       // of its dead time, by a wheel at rest
};

}  // namespace outrider
