// The exact cells of a boustrophedon: parts of a region that one back-and-forth covers.
//
// The region is cut into slabs across the lanes. Where a slab falls into several parts, an obstacle stands
// between them; parts of neighbouring slabs that touch only each other belong to one cell. So cells begin
// and end where the obstacles do, as in Choset and Pignon, Coverage path planning: the boustrophedon
// cellular decomposition (Field and Service Robotics, 1998), at the nearest border of a slab.
//
// The lane of a part is the segment in the middle of the slab as long as the part. For every point of the
// part the lane passes beside it, at most half the slab away; so if the region is half a slab inside of
// where the robot may stand, the lane is free, and a disk of that radius covers the part.
#pragma once

#include <stop_token>

#include "outrider/geometry/convex.hpp"
#include "outrider/jobs/cover/ground/region.hpp"

namespace outrider::cover {

struct SweepCell {
  std::vector<Segment> lanes;  ///< side by side, all in one direction
  Region area;
};

/// Cells of the region for lanes of that heading, no farther than `stride_m` from one to the next. Lanes
/// shorter than `least_m` are made so long. The slabs make the lanes short and few, where one more is worth
/// `change_m` (slab_cuts.hpp). After a stop request, only some cells. O(slabs n log n).
std::vector<SweepCell> sweep_cells(const Region& region, double heading_rad, double stride_m, double least_m,
                                   double change_m = 0.0, const std::stop_token& stop = {});

}  // namespace outrider::cover
