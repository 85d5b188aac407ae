#include "outrider/jobs/drive/mission/stop_check.hpp"

#include <fmt/format.h>

#include "outrider/core/units.hpp"
#include "outrider/estimate/localise.hpp"
#include "outrider/jobs/drive/task.hpp"

namespace outrider {
namespace {

constexpr std::size_t most_poses = 5;
constexpr double plausible_newest = 7.81;  ///< 95 % quantile of chi-squared with three degrees of freedom
/// 99.9 % quantile with eight degrees of freedom, for twice the expected noise of corners: that of far tags
/// in rendered images is larger than expected, and even a push of 1 cm moves corners by more.
constexpr double plausible_corners = 4.0 * 26.1;
constexpr double standard_deviations = 4.0;

/// Returns true if the belief is plausible for somebody who knows only that pose. The belief is built from
/// the pose as well, so its own covariance does not count.
bool is_plausible(const PoseBelief& belief, const PoseBelief& pose, double limit) {
  return squared_mahalanobis({belief.world_T_robot, Eigen::Matrix3d::Zero()}, pose) <= limit;
}

}  // namespace

void StopCheck::accept(const PoseBelief& pose) {
  ++accepted;
  poses.push_back(pose);
  if (poses.size() > most_poses) poses.pop_front();
}

void StopCheck::compare(std::span<const TagSighting> sightings, double corner_sigma_px, double time_s) {
  bool compared = false;
  for (const TagSighting& sighting : sightings) {
    MeanCorners& mean = corners[sighting.id];
    const double count = static_cast<double>(mean.images);
    double squares = 0.0;
    for (std::size_t i = 0; i < 4; ++i) squares += squared_norm(sighting.corners_px[i] - mean.px[i]);
    if (mean.images > 0 &&
        squares > plausible_corners * corner_sigma_px * corner_sigma_px * (1.0 + 1.0 / count))
      return restart(time_s);
    compared = compared || mean.images > 0;
    for (std::size_t i = 0; i < 4; ++i)
      mean.px[i] = mean.px[i] + (1.0 / (count + 1.0)) * (sighting.corners_px[i] - mean.px[i]);
    ++mean.images;
  }
  is_still = compared;
}

void StopCheck::restart(double time_s) {
  counts_from_s = time_s;
  accepted = 0;
  poses.clear();
  corners.clear();
  is_still = false;
}

void StopCheck::refuse(double time_s) {
  ++refused;
  restart(time_s);
}

std::string StopCheck::doubt(const PoseBelief& belief, const DriveRules& rules) const {
  if (accepted < rules.settle_sightings) {
    if (refused > 0) return fmt::format("{} images show tags where they cannot be", refused);
    return accepted == 0
               ? "no tag was of use there"
               : fmt::format("tags were of use in {} images, of {}", accepted, rules.settle_sightings);
  }
  const double sigma_m = position_sigma_m(belief), sigma_rad = heading_sigma_rad(belief);
  if (sigma_m > rules.settle_sigma_m || sigma_rad > rules.settle_sigma_rad) {
    return fmt::format("the belief has a standard deviation of {:.1f} mm and {:.2f} degrees", 1e3 * sigma_m,
                       degrees(sigma_rad));
  }
  PoseBelief mean = poses.front();
  for (std::size_t i = 1; i < poses.size(); ++i) mean = fuse(mean, poses[i]);
  if (!is_plausible(belief, mean, most_plausible_distance) ||
      !is_plausible(belief, poses.back(), plausible_newest))
    return "the last images do not agree with the belief";
  if (!is_still) return "no two images show the same tag at the same place";
  return {};
}

double tolerance_m(const DriveTask& task) {
  return task.follow.within_m + standard_deviations * task.rules.settle_sigma_m;
}
double tolerance_rad(const DriveTask& task) {
  return task.follow.within_rad + standard_deviations * task.rules.settle_sigma_rad;
}

}  // namespace outrider
