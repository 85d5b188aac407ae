#include "laser/odometry_bias.hpp"

#include "laser/keyframe_graph.hpp"
#include "outrider/core/units.hpp"

namespace outrider {

Pose2 OdometryBias::corrected(const Pose2& motion) const {
  const double turn_rad = bias_[1] * motion.position.x + bias_[2] * motion.heading_rad;
  return {(1.0 + bias_[0]) * rotated(0.5 * turn_rad, motion.position), motion.heading_rad + turn_rad};
}

void OdometryBias::count(const Pose2& motion) {
  if (!seen_) return;
  seen_->motion = wrap_heading(compose(seen_->motion, motion));
  seen_->ahead_m += motion.position.x;
}

void OdometryBias::learn(const Pose2& pose, const Eigen::Matrix3d& covariance, double way_variance,
                         double turn_variance) {
  constexpr double least_way_m = 0.1;
  const Eigen::Vector3d changes(2e-8, 2e-6, 2e-8);  // process noise of each update
  if (seen_) {
    covariance_.diagonal() += changes;
    const Pose2 truth = relative_pose(seen_->pose, pose);
    const Pose2& counted = seen_->motion;
    const Eigen::Matrix3d both = covariance + seen_->covariance;
    const double turn_rad = wrap_angle(truth.heading_rad - counted.heading_rad);
    weigh({0.0, seen_->ahead_m, counted.heading_rad}, turn_rad, turn_variance + both(2, 2));
    const double way_m = norm(counted.position);
    if (way_m >= least_way_m) {
      const Vec2 along = (1.0 / way_m) * counted.position;
      const Vec2 in_world = rotated(seen_->pose.heading_rad, along);
      const Eigen::Vector2d ahead(in_world.x, in_world.y);
      const double unsure = ahead.dot(both.topLeftCorner<2, 2>() * ahead);
      weigh({way_m, 0.0, 0.0}, dot(truth.position, along) - way_m, way_variance + unsure);
    }
  }
  seen_ = Seen{pose, covariance, {}, 0.0};
}

/// Kalman update with the measurement bias . by = residual; rejects outliers.
void OdometryBias::weigh(const Eigen::Vector3d& by, double residual, double variance) {
  constexpr double most_squared = 16.0;
  const Eigen::Vector3d image = covariance_ * by;
  const double sum = variance + by.dot(image);
  const double surprise = residual - by.dot(bias_);
  if (surprise * surprise > most_squared * sum) return;
  bias_ += image * surprise / sum;
  covariance_ -= image * image.transpose() / sum;
}

}  // namespace outrider
