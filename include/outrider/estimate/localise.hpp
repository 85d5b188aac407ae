// Localisation: estimates the pose of a robot on a floor from the tags that it sees.
//
// Each solution of each sighting gives a pose of the robot in space. The robot stands upright on the floor,
// so the normal distribution of the six pose parameters is conditioned on height, roll and pitch. Then at
// most one solution of each tag is chosen:
//   1. Sightings with ids that are not in the map are dropped as false detections.
//   2. Solutions that do not fit the floor, or the prior if there is one, are dropped (squared Mahalanobis
//      distance above the 99.9 % quantile times `gate`).
//   3. The largest set of solutions that all agree with one of them is chosen; of equally large sets, the one
//      with the lowest cost. The cost is the chi-squared of the corners, the floor and the prior, plus that
//      of the distances to the common solution.
//   4. The set is fused, weighted by inverse covariances. The result is refined by fitting the corners of
//      all its tags at once, because the errors of far tags are far from normally distributed.
// If a second set of the same size gives another pose at a similar cost, there is no answer. This happens,
// for example, with a single tag whose two solutions are both possible.
//
// The prior is only used to choose solutions, and as a second point of linearisation for the covariance. The
// pose is independent of it, so the caller may fuse both.
// Pure function; O(n^2) for n sightings. There are no faults: each sighting gets a verdict.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/core/units.hpp"
#include "outrider/estimate/belief.hpp"
#include "outrider/estimate/camera.hpp"
#include "outrider/estimate/tag.hpp"

namespace outrider {

struct LocaliseOptions {
  double floor_sigma_m = 0.01;            ///< standard deviation of the height of the robot above the floor
  double floor_sigma_rad = radians(0.5);  ///< standard deviation of its roll and of its pitch
  double tag_sigma_m = 0.005;    ///< standard deviation of the position of a tag in the map, along each axis
  double gate = 1.0;             ///< factor for the thresholds of the tests above
  double ambiguity = 9.0;        ///< chi-squared by which the best pose must beat another
  double corner_sigma_px = 0.2;  ///< expected error of a corner along each axis, > 0
};

std::vector<Option> describe(LocaliseOptions& options);

enum class TagVerdict {
  used,
  unknown_id,  ///< not in the map: a false detection, or an unlisted tag
  off_floor,   ///< no solution has the robot upright on the floor
  off_prior,   ///< no solution fits the prior
  outvoted,    ///< the other tags agree on another pose
  ambiguous,   ///< two poses are possible
};
/// Returns "used", "unknown_id", ...
std::string_view to_string(TagVerdict verdict);

/// The result of a localisation.
struct TagFix {
  std::optional<PoseBelief> belief;  ///< empty if no tag was used
  std::vector<TagVerdict> verdicts;  ///< by sighting
};

/// Estimates the pose of the robot as described above.
TagFix localise(std::span<const TagSighting> sightings, const TagMap& map, const RobotCamera& robot_camera,
                const std::optional<PoseBelief>& prior = std::nullopt, const LocaliseOptions& options = {});

/// Fuses two independent beliefs, weighted by their inverse covariances. The difference of the headings is
/// taken in (-pi, pi].
PoseBelief fuse(const PoseBelief& a, const PoseBelief& b);

/// Returns the squared Mahalanobis distance between two independent beliefs: chi-squared with 3 degrees of
/// freedom if both are of the same pose.
double squared_mahalanobis(const PoseBelief& a, const PoseBelief& b);

/// 99.9 % quantile of chi-squared with 3 degrees of freedom: beliefs that are farther apart are not of one
/// pose.
inline constexpr double most_plausible_distance = 16.27;

}  // namespace outrider
