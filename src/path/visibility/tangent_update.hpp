// How the legs that join the arcs of one ground become those of the next.
#pragma once

#include "tangent_graph.hpp"

namespace outrider {

/// Gives `graph`, which holds the legs of another ground, those of `now`, the same as found anew. A leg that
/// stays is tested against the new edges alone; looked for are the legs of the arcs that are new, and those
/// beside an edge that is gone. False, and nothing is done, when the radius differs or more than half of the
/// edges do. O(legs + a^2) for a arcs, and O(a) tests for each new arc.
Outcome<bool> update_legs(TangentGraph& graph, const std::shared_ptr<const PolygonGround>& now,
                          BudgetMeter& meter);

/// The way back along a leg that leaves `node`.
Departure way_back(const PolygonGround& ground, Node node, const Departure& leg);

}  // namespace outrider
