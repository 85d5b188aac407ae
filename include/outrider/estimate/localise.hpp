// Localise: the pose of a robot on a floor from the tags that it sees.
//
// Each solution of each sighting is a pose of the robot in space. The robot stands upright on the floor, so
// the normal distribution over six numbers is conditioned on height, roll and pitch. Then at most one
// solution of each tag is chosen:
//   1. sightings of ids that are not in the map are dropped as false detections;
//   2. solutions that do not fit the floor, or the prior if there is one, are dropped (squared Mahalanobis
//      distance beyond the 99.9 % quantile, times `gate`);
//   3. the largest set of solutions that all agree with one of them is chosen; of equal sets, the one with
//   the
//      least sum of distances;
//   4. the set is fused, weighted by inverse covariances, and the result is refined by fitting the corners of
//      all its tags at once, because the covariances of far tags are far from normal.
// If a second set of the same size gives another pose at a similar cost, as with a single tag whose two
// solutions are both possible, there is no answer. Costs are chi-squared: of the corners, the floor and the
// prior.
//
// The prior is used only to choose: the answer is independent of it, and the caller may fuse the two.
// Pure; O(n^2) for n sightings. No errors: each sighting gets a verdict.
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
  double floor_sigma_m = 0.01;            ///< of the robot's height above the floor
  double floor_sigma_rad = radians(0.5);  ///< of its roll and of its pitch
  double tag_sigma_m = 0.005;             ///< of where a tag of the map hangs, along each axis
  double gate = 1.0;                      ///< factor on the thresholds of the tests above
  double ambiguity = 9.0;                 ///< chi-squared by which the best pose must beat another
  double corner_sigma_px = 0.2;           ///< expected error of a corner along each axis, > 0
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
/// "used", "unknown_id", ...
std::string_view to_string(TagVerdict verdict);

struct TagFix {
  std::optional<PoseBelief> belief;  ///< empty if no tag was used
  std::vector<TagVerdict> verdicts;  ///< by sighting
};

TagFix localise(std::span<const TagSighting> sightings, const TagMap& map, const RobotCamera& robot_camera,
                const std::optional<PoseBelief>& prior = std::nullopt, const LocaliseOptions& options = {});

/// Fuses two independent beliefs, weighted by their inverse covariances. The difference of the headings is
/// taken in (-pi, pi].
PoseBelief fuse(const PoseBelief& a, const PoseBelief& b);

}  // namespace outrider
