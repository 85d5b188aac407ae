// Converts a chain of tangents to a Plan.
#pragma once

#include "outrider/path/visibility/visibility_graph.hpp"
#include "visibility_tangents.hpp"

namespace outrider {

/// One leg of the path found: the point where it leaves the previous arc, which the path entered at
/// `entered`.
struct WayLeg {
  Node round = 0;        ///< the arc left; not used for the first leg
  double entered = 0.0;  ///< progress on it, rad
  double left = 0.0;
  Vec2 to;  ///< end of the leg
};

Plan plan_of(const Problem& problem, const std::vector<WayLeg>& way, const CostWeights& weights,
             const VisibilityOptions& options, const PlanCounters& counters);

}  // namespace outrider
