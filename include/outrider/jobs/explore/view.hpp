// Views: from where the unknown beside a frontier would be seen, how soon the robot is there, and how much
// it would see.
//
// A place sees an unknown cell when it lies on one of 96 rays from the centre of that cell, no farther than
// `view_m`, that come there over free cells only: a scan from there settles the cell, whatever it holds.
// What lies around a corner is therefore viewed from where it opens up, and never from inside it. Of the
// places that see at least half of a sample of the unknown cells beside a frontier (or as many as any place
// does), the view is the one that is reached first.
//
// The gain is what a scan from there would show at best: the unknown area in sight over the range of the
// range finder where only occupied cells hide anything, summed over 180 rays. What is behind one frontier
// is counted along the rays through the sample alone.
//
// Refused are frontiers into which the middle of the robot fits nowhere (noise opens many a crack in a wall),
// that hide less than least_gain_m2, that are seen from nowhere or from nowhere that can be reached, whose
// views are all on the blacklist, and that were pursued for long in vain.
#pragma once

#include <cstdint>
#include <vector>

#include "outrider/jobs/explore/decide.hpp"

namespace outrider {

struct View {
  std::uint32_t frontier = 0;
  Pose2 pose;                        ///< facing what is to be seen
  std::uint32_t block = 0;           ///< of TraversabilityGrid::blocks() that holds it
  std::vector<std::uint32_t> seats;  ///< all blocks with places that see as much; by their number
  double turn_s = 0.0;               ///< towards the beginning of the way there
  double reach_s = 0.0;              ///< of driving there; for `nearest` near walls half as fast
  double gain_m2 = 0.0;
};

struct Views {
  std::vector<View> views;               ///< that of the choice before, then by reach_s and by frontier
  bool all = true;                       ///< no frontier was left out for its distance
  std::vector<RefusedFrontier> refused;  ///< by id
};

/// The views of the frontiers that are reached first, at most options.most_views of them.
Views find_views(const ExploreState& state, const ExploreOptions& options, Workspace& workspace);

/// Looks at every frontier whose surroundings have changed, and brings the ground for the planners up to
/// date, so that the next decision need not.
void prepare(FrontierMap& map, const ExploreOptions& options);

}  // namespace outrider
