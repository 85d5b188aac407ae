// Updates of the legs that join the arcs of one ground to those of the next ground.
#pragma once

#include "tangent_graph.hpp"

namespace outrider {

/// Updates `graph`, which holds the legs of another ground, to those of `now`; the result equals legs found
/// from scratch. Remaining legs are tested only against the new edges; new legs are searched at new arcs and
/// beside removed edges. Returns false, and changes nothing, if the radius or more than half of the edges
/// differ. O(legs + a^2) for a arcs, and O(a) tests for each new arc.
Outcome<bool> update_legs(TangentGraph& graph, const std::shared_ptr<const PolygonGround>& now,
                          BudgetMeter& meter);

/// Returns the reverse of a leg that leaves `node`.
Departure way_back(const PolygonGround& ground, Node node, const Departure& leg);

}  // namespace outrider
