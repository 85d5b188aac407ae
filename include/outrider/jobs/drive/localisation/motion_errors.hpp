// MotionErrors: how a robot moves differently from what is commanded, estimated online together with its
// pose.
//
// Five states: for each wheel the relative error of its speed, and the fraction of sideways motion that is
// lost to slip. They extend the state of the Kalman filter of the pose (dead_reckoning.hpp). Their covariance
// with the pose grows while the robot moves, so a correction of the pose by tags corrects them too. They
// wander slowly while the robot moves, because batteries sag and floors change. Source: Larsen, Bak, Andersen
// and Ravn, Location estimation for an autonomously guided vehicle using an augmented Kalman filter to
// autocalibrate the odometry (FUSION 1998).
#pragma once

#include <Eigen/Core>

#include "outrider/motion/chassis.hpp"

namespace outrider {

inline constexpr Eigen::Index motion_error_count = 5;  ///< most_wheels wheels, then the slip
using MotionErrorVector = Eigen::Matrix<double, motion_error_count, 1>;
using MotionErrorCovariance = Eigen::Matrix<double, motion_error_count, motion_error_count>;
using MotionErrorRows = Eigen::Matrix<double, 3, motion_error_count>;

/// The estimated errors. By default they are known to be zero.
struct MotionErrors {
  MotionErrorVector mean =
      MotionErrorVector::Zero();  ///< 0.1: the wheel turns 10 % faster; half is lost: 0.5
  MotionErrorCovariance covariance = MotionErrorCovariance::Zero();
  MotionErrorRows with_pose = MotionErrorRows::Zero();  ///< covariance of the pose (rows) with the errors
};

/// Returns errors of zero with these standard deviations. A chassis that does not move sideways has no slip,
/// and wheels that it does not have have no error.
MotionErrors unknown_errors(const Chassis& chassis, double wheel_sigma, double slip_sigma);

/// Returns the twist with which the robot moves if it is commanded `twist` and has these errors.
Twist2 executed(const Chassis& chassis, const MotionErrorVector& errors, const Twist2& twist);

/// Returns the derivative of executed() with respect to the errors; rows: ahead, left, turn.
MotionErrorRows executed_by_errors(const Chassis& chassis, const MotionErrorVector& errors,
                                   const Twist2& twist);

/// Returns the command with which a robot that has these errors moves with the twist `wanted`. Errors so
/// large that it hardly moves at all are made up for in part.
Twist2 commanded_for(const Chassis& chassis, const MotionErrorVector& errors, const Twist2& wanted);

}  // namespace outrider
