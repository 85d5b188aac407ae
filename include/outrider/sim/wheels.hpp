// Wheels: how a robot on two driven wheels follows a pose that moves.
//
// Source of the law: Kanayama, Kimura, Miyazaki and Noguchi, A stable tracking control method for an
// autonomous mobile robot (ICRA 1990), with a term that turns towards the heading also at rest.
#pragma once

#include "outrider/motion/robot_model.hpp"

namespace outrider {

/// The parts of a robot on wheels that fits into a model's disk, m.
struct WheelBase {
  double wheel_radius_m = 0.0;
  double half_track_m = 0.0;  ///< from the middle to each wheel, and to each caster
};
WheelBase wheel_base(const RobotModel& robot);

struct WheelSpeeds {
  double left_radps = 0.0;
  double right_radps = 0.0;
};

/// Where the robot should be, and how it should move there.
struct Reference {
  Pose2 pose;
  double speed_mps = 0.0;
  double turn_rate_radps = 0.0;
};

/// What the wheels should do for a robot at `actual` to get to the reference and stay with it. Without slip
/// the error ahead falls as e^(-5 t), that of the heading as e^(-8 t) in place and critically damped,
/// together with the error aside, at 0.8 m/s.
WheelSpeeds follow(const Reference& reference, const Pose2& actual, const WheelBase& base);

}  // namespace outrider
