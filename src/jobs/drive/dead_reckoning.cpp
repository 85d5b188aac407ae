#include "outrider/jobs/drive/dead_reckoning.hpp"

#include <algorithm>
#include <cmath>

#include "outrider/core/units.hpp"

namespace outrider {
namespace {

constexpr double memory_s = 1.0;  ///< for which a drift lasts

/// P -> F P F^T + Q for a step that brings the belief from one pose to another.
void propagate(Eigen::Matrix3d& p, Vec2 step, double turn_rad, double duration_s,
               const ReckoningOptions& options) {
  const double f[2] = {-step.y, step.x};  // d position / d heading
  const double cross[2] = {p(0, 2) + f[0] * p(2, 2), p(1, 2) + f[1] * p(2, 2)};
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 2; ++j) p(i, j) += f[i] * p(2, j) + cross[i] * f[j];
  }
  for (int i = 0; i < 2; ++i) p(i, 2) = p(2, i) = cross[i];
  const double lasts = memory_s / duration_s;
  const double along = options.drift * options.drift * squared_norm(step) * lasts;
  p(0, 0) += along;
  p(1, 1) += along;
  p(2, 2) += (options.drift * options.drift * turn_rad * turn_rad +
              options.drift_radpm * options.drift_radpm * squared_norm(step)) *
             lasts;
}

/// With the same target all the time.
void advance_steadily(Reckoning& reckoning, double until_s, const ReckoningOptions& options) {
  const double duration_s = until_s - reckoning.time_s;
  if (duration_s <= 0.0) return;
  const double left = options.lag_s > 0.0 ? std::exp(-duration_s / options.lag_s) : 0.0;
  const Twist2 off = reckoning.twist + -1.0 * reckoning.target;
  const Twist2 mean = reckoning.target + (options.lag_s * (1.0 - left) / duration_s) * off;
  Pose2& pose = reckoning.belief.world_T_robot;
  const Pose2 before = pose;
  pose = moved(pose, mean, duration_s);
  pose.heading_rad = wrap_angle(pose.heading_rad);
  propagate(reckoning.belief.covariance, pose.position - before.position, mean.turn_radps * duration_s,
            duration_s, options);
  reckoning.twist = reckoning.target + left * off;
  reckoning.time_s = until_s;
}

}  // namespace

std::vector<Option> describe(ReckoningOptions& options) {
  return {
      {"delay", "s", 0.0, 5.0, "between a command and its effect", &options.delay_s},
      {"lag", "s", 0.0, 5.0, "time constant with which the robot follows a command", &options.lag_s},
      {"drift", "", 0.0, 1.0, "standard deviation of the speed and of the turn rate, relative",
       &options.drift},
      {"drift_per_m", "rad/m", 0.0, 10.0, "standard deviation of the turn rate, per speed",
       &options.drift_radpm},
      {"lost", "m", 0.01, 100.0, "a larger standard deviation of the position is lost", &options.lost_m},
      {"lost_angle", "deg", 0.1, 180.0, "a larger standard deviation of the heading is lost",
       &options.lost_rad},
  };
}

void advance(Reckoning& reckoning, double until_s, const ReckoningOptions& options) {
  while (!reckoning.sent.empty() && reckoning.sent.front().at_s + options.delay_s <= until_s) {
    advance_steadily(reckoning, reckoning.sent.front().at_s + options.delay_s, options);
    reckoning.target = reckoning.sent.front().twist;
    reckoning.sent.pop_front();
  }
  advance_steadily(reckoning, until_s, options);
}

double position_sigma_m(const PoseBelief& belief) {
  const Eigen::Matrix3d& p = belief.covariance;
  const double mean = 0.5 * (p(0, 0) + p(1, 1));
  const double half = 0.5 * (p(0, 0) - p(1, 1));
  return std::sqrt(std::max(0.0, mean + std::sqrt(half * half + p(0, 1) * p(0, 1))));
}

double heading_sigma_rad(const PoseBelief& belief) {
  return std::sqrt(std::max(0.0, belief.covariance(2, 2)));
}

bool is_lost(const PoseBelief& belief, const ReckoningOptions& options) {
  return position_sigma_m(belief) > options.lost_m || heading_sigma_rad(belief) > options.lost_rad;
}

}  // namespace outrider
