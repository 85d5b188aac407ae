// Are the ranges of a laser too long or too short?
//
// A range that is too long by b moves a point of a wall by b along its beam, so by b cos(angle of incidence)
// across the wall. A wall that is seen straight on from one place and at a flat angle from another then does
// not lie at the same place in the two scans. The bias is that of least squares over such points of keyframes
// a few steps apart. Poses that were matched with biased scans take in a part of it, so the true bias is
// about 1.4 times as large.
#pragma once

#include "keyframe_surfaces.hpp"

namespace outrider {

/// Returns the bias, m; 0 if too little was seen from different angles. O(keyframes x points).
double range_bias_m(const KeyframeGraph& graph, KeyframeSurfaces& surfaces);

}  // namespace outrider
