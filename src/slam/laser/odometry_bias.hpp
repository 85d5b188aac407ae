// Estimates the systematic errors of wheel odometry from matched scans.
//
// Wrong wheel radii or a wrong track make three errors: a scale error of the distance, a scale error of the
// turn, and a turn per metre driven. A Kalman filter estimates them: it compares the odometry between two
// matched scans with their relative pose. Directions that the scans determine poorly, as along a corridor,
// get little weight. The errors may drift slowly. Source: Martinelli, Tomatis and Siegwart, Simultaneous
// localization and odometry self calibration for mobile robot, Autonomous Robots 22 (2007) 75-85.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "outrider/geometry/pose.hpp"

namespace outrider {

class OdometryBias {
 public:
  /// Returns a motion by odometry, in the frame of the robot before it, with the estimated errors removed.
  [[nodiscard]] Pose2 corrected(const Pose2& motion) const;

  /// Accumulates a motion by odometry.
  void count(const Pose2& motion);
  /// Updates the estimate with a matched pose in the world and its covariance. The variances are those of the
  /// random odometry error since the last matched pose.
  void learn(const Pose2& pose, const Eigen::Matrix3d& covariance, double way_variance, double turn_variance);
  /// Discards the motion since the last matched pose.
  void forget() { seen_.reset(); }

 private:
  struct Seen {
    Pose2 pose;
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
    Pose2 motion;  ///< motion accumulated since then
    double ahead_m = 0.0;
  };
  void weigh(const Eigen::Vector3d& by, double residual, double variance);

  std::optional<Seen> seen_;
  Eigen::Vector3d bias_ =
      Eigen::Vector3d::Zero();  ///< scale of the distance, rad per metre ahead, scale of the turn
  Eigen::Matrix3d covariance_ = Eigen::Vector3d(1e-3, 1e-2, 1e-3).asDiagonal();
};

}  // namespace outrider
