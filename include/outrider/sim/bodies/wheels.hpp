// A tracking controller for a differential-drive robot: it follows a moving reference pose.
//
// Source: Kanayama, Kimura, Miyazaki and Noguchi, A stable tracking control method for an autonomous mobile
// robot (ICRA 1990), with an additional term that corrects the heading also at rest.
#pragma once

#include "outrider/motion/robot_model.hpp"

namespace outrider {

/// Dimensions of the wheels.
struct WheelBase {
  double wheel_radius_m = 0.0;
  double half_track_m = 0.0;  ///< distance from the centre to each wheel and to each caster
};
/// Returns the dimensions of wheels that fit into the disk of the robot.
WheelBase wheel_base(const RobotModel& robot);

struct WheelSpeeds {
  double left_radps = 0.0;
  double right_radps = 0.0;
};

/// The reference of the controller: a pose and its velocity.
struct Reference {
  Pose2 pose;
  double speed_mps = 0.0;
  double turn_rate_radps = 0.0;
};

/// Returns the wheel speeds with which a robot at `actual` approaches and follows the reference. Without slip
/// the longitudinal error decays as e^(-5 t), and the heading error at rest as e^(-8 t). At 0.8 m/s the
/// lateral error and the heading error are critically damped. Speed and turn rate stay within the limits of
/// the robot: errors of a reference that moves at a limit remain until it slows down.
WheelSpeeds follow(const Reference& reference, const Pose2& actual, const RobotModel& robot);

}  // namespace outrider
