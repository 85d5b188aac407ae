// TagVotes: which tags put a robot that stands at a stop where it believes to be, without the others.
//
// A tag may have been moved, by less than a wide belief can tell. So each tag alone, and all tags of an image
// but one, give estimates of the position of their own: the mean of what the images since the robot stands
// say, weighted by inverse covariances, relative to dead reckoning without corrections. If for each tag some
// estimate without it agrees with the belief, that bounds the error, whichever tag was moved: solution
// separation, as for satellites (Brown and McBurney, Self-contained GPS integrity check using maximum
// solution separation, Navigation 35, 1988). The estimates survive a turn in place, as they are of the
// position. But a tag that was moved makes the robot learn that turns displace it, by centimetres, so what
// dead reckoning says that it moved since an estimate counts as an error of that estimate. O(tags^2) an
// image.
#pragma once

#include <map>
#include <set>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "outrider/estimate/localise.hpp"

namespace outrider {

struct TagVotes {
  /// The sum of what tags say: position minus dead reckoning in the world, as information.
  struct Vote {
    Eigen::Matrix2d information = Eigen::Matrix2d::Zero();
    Eigen::Vector2d weighted_m = Eigen::Vector2d::Zero();
    Eigen::Vector2d weighted_reckoned_m = Eigen::Vector2d::Zero();  ///< the same of dead reckoning itself
  };
  std::map<std::set<int>, Vote> votes;                    ///< by the ids of the tags
  Eigen::Vector2d corrected_m = Eigen::Vector2d::Zero();  ///< by which the belief was corrected meanwhile

  /// Notes that an image corrected the belief.
  void note_correction(const PoseBelief& before, const PoseBelief& after);

  /// Adds the tags of an image that explain it (`verdicts`, by sighting), with the belief that it led to.
  void add(std::span<const TagSighting> sightings, std::span<const TagVerdict> verdicts,
           const PoseBelief& belief, const TagMap& map, const RobotCamera& camera,
           const LocaliseOptions& options);

  /// Returns the sets of tags that put the robot within `most_m` of where it is believed to be, with 2
  /// standard deviations, and half of what it moved since by dead reckoning, to spare.
  [[nodiscard]] std::vector<std::set<int>> agreeing(Vec2 believed, double most_m) const;

 private:
  /// Returns the position by dead reckoning without corrections.
  [[nodiscard]] Eigen::Vector2d reckoned_m(Vec2 believed) const {
    return Eigen::Vector2d(believed.x, believed.y) - corrected_m;
  }
};

}  // namespace outrider
