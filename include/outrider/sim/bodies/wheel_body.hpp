// WheelBody: a wheeled robot with faults of its wheels and of the link that carries its commands.
//
// The motion is simulated in steps of 5 ms. The newest command that has arrived sets the speed of each wheel,
// subject to dead time, deadband and lag. Gains, voltage sag and noise give the true wheel speed. The chassis
// converts the wheel speeds to a twist, and slip removes a fraction of its sideways part. The noise of each
// wheel is a first-order Gauss-Markov process. The same seed and commands give the same motion. O(wheels) per
// step.
#pragma once

#include "outrider/core/rng.hpp"
#include "outrider/motion/wheel_faults.hpp"
#include "outrider/robot/command.hpp"
#include "outrider/sim/simulated_link.hpp"

namespace outrider {

class WheelBody {
 public:
  /// The wheels stop if no command has arrived for `patience_s`, as the bases of real robots do.
  WheelBody(Chassis chassis, const WheelFaults& faults, const LinkFaults& link, double patience_s,
            const Pose2& start, const Rng& rng);

  /// Sends a command over the link at the present time.
  void send(const WheelSpeeds4& wheels);
  /// Begins a DriveWheels and returns its end time; other commands end at once.
  double begin(const Command& command);
  /// Simulates until `time_s`, in whole steps and a shorter last one.
  void run_until(double time_s);
  /// Moves the robot to another pose at once (kidnapping).
  void put(const Pose2& pose) { pose_ = pose; }

  [[nodiscard]] double time_s() const { return time_s_; }
  [[nodiscard]] const Pose2& pose() const { return pose_; }     ///< heading not wrapped
  [[nodiscard]] const Twist2& twist() const { return twist_; }  ///< true twist in the last step
  [[nodiscard]] double driven_m() const { return driven_m_; }
  [[nodiscard]] double turned_rad() const { return turned_rad_; }

 private:
  void pass(double duration_s);
  double turn_wheel(std::size_t wheel, double duration_s);

  Chassis chassis_;
  WheelFaults faults_;
  SimulatedLink<WheelSpeeds4> link_;
  double patience_s_;
  double arrived_s_ = 0.0;  // the newest message
  Rng wheel_rng_;
  double time_s_ = 0.0;
  Pose2 pose_;
  Twist2 twist_;
  double driven_m_ = 0.0;
  double turned_rad_ = 0.0;
  double moving_s_ = 0.0;     // time driven so far; the battery sags with it
  WheelSpeeds4 commanded_{};  // speeds of the newest message that has arrived
  WheelSpeeds4 followed_{};   // speeds after the lag
  WheelSpeeds4 noise_{};      // relative noise of each wheel
  WheelSpeeds4 waited_s_{};   // elapsed part of the dead time of each wheel at rest
};

}  // namespace outrider
