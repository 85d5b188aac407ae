#include "outrider/jobs/drive/localisation/motion_errors.hpp"

namespace outrider {
namespace {

constexpr Eigen::Index slip = most_wheels;  ///< index of the slip

/// Returns the speeds of the wheels with their errors.
WheelSpeeds4 true_speeds(const Chassis& chassis, const MotionErrorVector& errors, const Twist2& twist) {
  WheelSpeeds4 speeds = wheel_speeds(chassis, twist);
  for (std::size_t i = 0; i < chassis.wheels.size(); ++i)
    speeds[i] *= 1.0 + errors[static_cast<Eigen::Index>(i)];
  return speeds;
}

}  // namespace

MotionErrors unknown_errors(const Chassis& chassis, double wheel_sigma, double slip_sigma) {
  MotionErrors errors;
  const auto wheels = static_cast<Eigen::Index>(chassis.wheels.size());
  errors.covariance.diagonal().head(wheels).setConstant(wheel_sigma * wheel_sigma);
  if (chassis.moves_sideways()) errors.covariance(slip, slip) = slip_sigma * slip_sigma;
  return errors;
}

Twist2 executed(const Chassis& chassis, const MotionErrorVector& errors, const Twist2& twist) {
  Twist2 moves = twist_of(chassis, true_speeds(chassis, errors, twist));
  moves.left_mps *= 1.0 - errors[slip];
  return moves;
}

MotionErrorRows executed_by_errors(const Chassis& chassis, const MotionErrorVector& errors,
                                   const Twist2& twist) {
  MotionErrorRows rows = MotionErrorRows::Zero();
  const WheelSpeeds4 commanded = wheel_speeds(chassis, twist);
  for (std::size_t i = 0; i < chassis.wheels.size(); ++i) {
    WheelSpeeds4 alone{};  // a twist is linear in the speeds of the wheels
    alone[i] = commanded[i];
    const Twist2 share = twist_of(chassis, alone);
    rows.col(static_cast<Eigen::Index>(i)) << share.ahead_mps, (1.0 - errors[slip]) * share.left_mps,
        share.turn_radps;
  }
  rows(1, slip) = -twist_of(chassis, true_speeds(chassis, errors, twist)).left_mps;
  return rows;
}

/// The twist is linear in the command; the iteration converges if the errors are below 100 %.
Twist2 commanded_for(const Chassis& chassis, const MotionErrorVector& errors, const Twist2& wanted) {
  constexpr int iterations = 8;
  const MotionErrorVector bounded = errors.cwiseMax(-0.5).cwiseMin(0.5);
  Twist2 command = wanted;
  for (int i = 0; i < iterations; ++i)
    command = command + wanted + -1.0 * executed(chassis, bounded, command);
  return command;
}

}  // namespace outrider
