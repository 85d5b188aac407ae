// Cuts a region into slabs for lanes along x, so that the lanes are short and few.
//
// Slabs of even height waste length in tapers and beside steps: a lane is as long as the longest stretch of
// its slab. A dynamic programme over heights (the corners, an even grid and one eight times finer than the
// stride) chooses the cuts that make the sum of the lanes, with `change_m` for each, least, and even slabs
// where that is the same. The length of a lane is judged by rays through the slab; whatever the cuts are,
// slabs are at most a stride high.
#pragma once

#include <stop_token>
#include <vector>

#include "outrider/jobs/cover/ground/region.hpp"

namespace outrider::cover {

/// Returns the cuts in rising order, with both ends. O(c n + c k) for n edges, c heights, of which k lie
/// within a stride. After a stop request, only the ends.
std::vector<double> slab_cuts(const RingedPolygon& polygon, double stride_m, double change_m,
                              const std::stop_token& stop = {});

}  // namespace outrider::cover
