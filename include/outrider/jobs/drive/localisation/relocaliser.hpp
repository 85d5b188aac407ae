// Relocaliser: finds a robot again whose belief contradicts the tags in sight, from these tags alone.
//
// While the robot stands, each image gives a pose without a prior, unless its tags leave two poses open.
// Poses of consecutive images that agree are fused; one that does not agree starts anew. Enough of them in a
// row are an answer. A tag that hangs elsewhere than the map says gives a wrong answer that looks right, so
// the answer counts as corroborated only once two different tags agree on it. O(tags^2) an image.
#pragma once

#include <optional>
#include <set>
#include <span>

#include "outrider/estimate/localise.hpp"

namespace outrider {

/// The state of the search.
struct Relocaliser {
  std::optional<PoseBelief> pose = {};  ///< fused pose of the images that agree
  std::int64_t images = 0;              ///< number of these images
  std::set<int> tags = {};              ///< ids of the tags in them
  /// Number of all images whose tags contradict one another or the floor, wherever the robot stands.
  std::int64_t contradictory = 0;

  /// Adds the tags of an image that is taken while the robot stands.
  void add(std::span<const TagSighting> sightings, const TagMap& map, const RobotCamera& camera,
           const LocaliseOptions& options);
};

}  // namespace outrider
