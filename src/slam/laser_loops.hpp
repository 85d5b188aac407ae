// Loop closing: recognises a place that was visited before and adds a constraint between the two visits.
//
// The last keyframes, joined rigidly, are matched with the keyframes of each earlier visit whose uncertainty
// allows the same place. A match is accepted if most points lie on a surface, no other pose in the window
// scores nearly as well, and the optimised graph still agrees with the constraint.
#pragma once

#include <optional>
#include <utility>

#include "keyframe_surfaces.hpp"
#include "surface_map.hpp"

namespace outrider {

struct LoopSearch {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> closed;  ///< keyframes: the earlier, the later
  double tried_at_m = 0.0;                                      ///< distance driven at the last search

  /// Adds constraints between the last keyframe and earlier visits and optimises the graph; returns true if
  /// it added any. Rejects a match farther than `reach_sd` standard deviations from the believed pose.
  bool close(KeyframeGraph& graph, KeyframeSurfaces& surfaces, double reach_sd);
};

}  // namespace outrider
