// What the wheels always count wrong, learnt while scans tell the truth.
//
// Wheels that are larger or smaller than believed, or stand wider, make three errors: of the way and of the
// turn in parts of them, and a turn for each metre driven, which bends the way where nothing is seen. A
// Kalman filter of the three takes what the odometry says between two matched scans against how the matches
// lie by each other; what the points say little of, as the way along a corridor, counts little. The three
// may change slowly.
// Source: Martinelli, Tomatis and Siegwart, Simultaneous localization and odometry self calibration for
// mobile robot, Autonomous Robots 22 (2007) 75-85.
#pragma once

#include <optional>

#include "outrider/slam/matrix.hpp"

namespace outrider {

class OdometryBias {
 public:
  /// A motion by odometry, in the frame of the robot before it, without what is known to be wrong.
  [[nodiscard]] Pose2 corrected(const Pose2& motion) const;

  /// The robot has moved, by odometry.
  void count(const Pose2& motion);
  /// The robot is seen to be there, in the world, with that covariance; since it was last seen odometry has
  /// erred at random with those variances.
  void learn(const Pose2& pose, const Matrix3& covariance, double way_variance, double turn_variance);
  /// The robot is not seen: what it counted since it last was teaches nothing.
  void forget() { seen_.reset(); }

 private:
  struct Seen {
    Pose2 pose;
    Matrix3 covariance;
    Pose2 motion;  ///< counted since
    double ahead_m = 0.0;
  };
  void weigh(const std::array<double, 3>& by, double residual, double variance);

  std::optional<Seen> seen_;
  std::array<double, 3> bias_{};  ///< of the way, rad of turn a metre ahead, of the turn
  Matrix3 covariance_ = diagonal<3>({1e-3, 1e-2, 1e-3});
};

}  // namespace outrider
