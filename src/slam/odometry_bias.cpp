#include "odometry_bias.hpp"

#include "key_graph.hpp"
#include "outrider/core/units.hpp"

namespace outrider {

Pose2 OdometryBias::corrected(const Pose2& motion) const {
  const double turn_rad = bias_[1] * motion.position.x + bias_[2] * motion.heading_rad;
  return {(1.0 + bias_[0]) * rotated(0.5 * turn_rad, motion.position), motion.heading_rad + turn_rad};
}

void OdometryBias::count(const Pose2& motion) {
  if (!seen_) return;
  seen_->motion = composed(seen_->motion, motion);
  seen_->ahead_m += motion.position.x;
}

void OdometryBias::learn(const Pose2& pose, const Matrix3& covariance, double way_variance,
                         double turn_variance) {
  constexpr double least_way_m = 0.1;
  constexpr Matrix3 changes = diagonal<3>({2e-8, 2e-6, 2e-8});  // variance that a look adds
  if (seen_) {
    covariance_ += changes;
    const Pose2 truth = between(seen_->pose, pose);
    const Pose2& counted = seen_->motion;
    const Matrix3 both = covariance + seen_->covariance;
    const double turn_rad = wrap_angle(truth.heading_rad - counted.heading_rad);
    weigh({0.0, seen_->ahead_m, counted.heading_rad}, turn_rad, turn_variance + both(2, 2));
    const double way_m = norm(counted.position);
    if (way_m >= least_way_m) {
      const Vec2 along = (1.0 / way_m) * counted.position;
      const Vec2 in_world = rotated(seen_->pose.heading_rad, along);
      const double unsure = quadratic_form(both, {in_world.x, in_world.y, 0.0});
      weigh({way_m, 0.0, 0.0}, dot(truth.position, along) - way_m, way_variance + unsure);
    }
  }
  seen_ = Seen{pose, covariance, {}, 0.0};
}

/// The filter's step with bias . by = residual; what is beyond belief is left out.
void OdometryBias::weigh(const std::array<double, 3>& by, double residual, double variance) {
  constexpr double most_squared = 16.0;
  const std::array<double, 3> image = covariance_ * by;
  double sum = variance;
  double surprise = residual;
  for (std::size_t i = 0; i < 3; ++i) {
    sum += by[i] * image[i];
    surprise -= by[i] * bias_[i];
  }
  if (surprise * surprise > most_squared * sum) return;
  for (std::size_t i = 0; i < 3; ++i) {
    bias_[i] += image[i] * surprise / sum;
    for (std::size_t j = 0; j < 3; ++j) covariance_(i, j) -= image[i] * image[j] / sum;
  }
}

}  // namespace outrider
