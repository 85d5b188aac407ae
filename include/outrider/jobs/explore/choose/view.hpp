// find_views(): the poses from which the unknown cells beside frontiers are visible, their travel times and
// their gains.
//
// A place sees an unknown cell if it lies on one of 96 rays from the centre of that cell, no farther than
// `view_m`, and the ray crosses only free cells: a scan from there determines the cell. So the robot views
// what lies around a corner from where it opens up, never from inside. Of the places that see at least half
// of a sample of the unknown cells beside a frontier (or as many as any place does), the view is the one with
// the shortest travel time.
//
// The gain is the most that a scan from there can show: the unknown area within the range of the range finder
// that is not hidden by occupied cells, summed over 180 rays. For the area behind one frontier only rays
// through the sample count.
//
// Frontiers are refused if the centre of the robot fits nowhere into them (noise opens many gaps in walls),
// if they hide less than least_gain_m2, if no reachable place sees them, if all their views are banned, and
// if they were pursued in vain for long.
#pragma once

#include <cstdint>
#include <vector>

#include "outrider/jobs/explore/choose/decide.hpp"

namespace outrider {

/// A view of a frontier.
struct View {
  std::uint32_t frontier = 0;        ///< id
  Pose2 pose;                        ///< faces the unknown cells
  std::uint32_t block = 0;           ///< cell of TraversabilityGrid::blocks() that holds it
  std::vector<std::uint32_t> seats;  ///< all blocks with places that see as much, ascending
  double turn_s = 0.0;               ///< time to turn towards the start of the path
  double reach_s = 0.0;              ///< driving time; `nearest` counts half the speed near walls
  double gain_m2 = 0.0;              ///< unknown area that a scan can show
};

/// The views of a decision.
struct Views {
  std::vector<View> views;               ///< the view of the previous choice, then by reach_s and frontier
  bool all = true;                       ///< no frontier was skipped because of its distance
  std::vector<RefusedFrontier> refused;  ///< by id
};

/// Returns the views of the frontiers with the shortest travel times, at most options.most_views of them.
Views find_views(const ExploreState& state, const ExploreOptions& options, Workspace& workspace);

/// Updates the views of every frontier whose surroundings have changed, and the grid for the planners, so
/// that the next decision is fast.
void prepare(FrontierMap& map, const ExploreOptions& options);

}  // namespace outrider
