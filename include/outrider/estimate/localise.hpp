// Localise: the pose of a robot on a floor from the tags that it sees.
//
// Each solution of each sighting says where the robot is in space. A robot stands upright on the floor, so
// what it says of height, roll and pitch must fit, and is used: the distribution over six numbers is
// conditioned on those three. Then one solution of each tag is chosen:
//   1. ids that are not in the map are ghosts and go;
//   2. a solution goes that does not fit the floor, or the prior where there is one (Mahalanobis distance
//      squared beyond the 99.9 % quantile, and `gate` times as much);
//   3. of the solutions that are left, the largest set in which all agree with one of them is taken, one
//      for each tag; of equal ones that of the least distances;
//   4. the set is fused, each weighed by the inverse of its covariance, and from there the corners of all its
//      tags are fitted at once: far tags bend the covariances that this would otherwise rest on.
// Where a second set as large says another place and costs hardly more, as with a lone tag whose solutions
// are both possible, nothing is said. Costs are chi-squared: of the corners, the floor and the prior.
//
// The prior only chooses: the answer is independent of it, and may be fused with it by the caller.
// Pure; O(n^2) for n sightings. Errors: none, each sighting says what became of it.
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
  double gate = 1.0;                      ///< widens what still fits
  double ambiguity = 9.0;                 ///< by which a place must beat another, as chi-squared
  double corner_sigma_px = 0.2;           ///< expected error of a corner along each axis, > 0
};

std::vector<Option> describe(LocaliseOptions& options);

enum class TagVerdict {
  used,
  unknown_id,  ///< not in the map: a ghost, or a tag that nobody told of
  off_floor,   ///< no solution puts the robot upright on the floor
  off_prior,   ///< no solution is where the robot can be
  outvoted,    ///< the other tags agree on another place
  ambiguous,   ///< two places are possible
};
/// "used", "unknown_id", ...
std::string_view to_string(TagVerdict verdict);

struct TagFix {
  std::optional<PoseBelief> belief;  ///< nothing when no tag was used
  std::vector<TagVerdict> verdicts;  ///< by sighting
};

TagFix localise(std::span<const TagSighting> sightings, const TagMap& map, const RobotCamera& robot_camera,
                const std::optional<PoseBelief>& prior = std::nullopt, const LocaliseOptions& options = {});

/// For comparison, the rule of the report on waypoints: the first solution of each known tag, weighed by the
/// inverse of the distance to the tag. Nothing when no tag is known.
std::optional<Pose2> average_by_inverse_distance(std::span<const TagSighting> sightings, const TagMap& map,
                                                 const RobotCamera& robot_camera);

/// The two beliefs as one, each weighed by the inverse of its covariance; headings by their difference in
/// (-pi, pi].
PoseBelief fused(const PoseBelief& a, const PoseBelief& b);

}  // namespace outrider
