#include "outrider/slam/landmark/landmark_check.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "algebra/symmetric_eigen.hpp"

namespace outrider {
namespace {

constexpr std::size_t every_steps = 20;
constexpr double least_sd_m = 0.01;               // linearisation and rounding
constexpr double most_squared_sds = 4.0 * 18.42;  // twice the error that 0.9999 of all do not exceed

/// Returns the covariance that the difference of two estimates of a consistent filter has, in each direction
/// at least `least_sd_m` squared.
Eigen::Matrix2d difference_covariance(const Eigen::Matrix2d& earlier, const Eigen::Matrix2d& later) {
  const auto [values, axes] = eigen_of_symmetric<2>(earlier - later);
  const Eigen::Vector2d variances = values.cwiseMax(least_sd_m * least_sd_m);
  return axes * variances.asDiagonal() * axes.transpose();
}

/// Returns the squared Mahalanobis distance between two estimates of a landmark.
double squared_mahalanobis(const LandmarkEstimate& earlier, const LandmarkEstimate& later) {
  const Vec2 moved = later.position - earlier.position;
  const Eigen::Vector2d off(moved.x, moved.y);
  return off.dot(difference_covariance(earlier.covariance, later.covariance).inverse() * off);
}

}  // namespace

void LandmarkCheck::note(std::size_t step, const LandmarkMap& map) {
  if (map.empty()) return;
  const bool has_new =
      kept_.empty() || map.size() != kept_.back().map.size() || map.back().id != kept_.back().map.back().id;
  if (has_new || step >= kept_.back().step + every_steps) kept_.push_back({step, map});
}

std::vector<MovedLandmark> LandmarkCheck::judge(const LandmarkMap& last) const {
  std::vector<MovedLandmark> result;
  for (const LandmarkEstimate& now : last) {
    double worst = most_squared_sds;
    MovedLandmark moved{now.id};
    for (const Kept& kept : kept_) {
      const auto then = std::ranges::find(kept.map, now.id, &LandmarkEstimate::id);
      if (then == kept.map.end()) continue;
      const double squared = squared_mahalanobis(*then, now);
      if (squared <= worst) continue;
      worst = squared;
      moved.step = kept.step;
      moved.moved_m = distance(then->position, now.position);
      moved.sd_m = moved.moved_m / std::sqrt(squared);
    }
    if (worst > most_squared_sds) result.push_back(moved);
  }
  return result;
}

}  // namespace outrider
