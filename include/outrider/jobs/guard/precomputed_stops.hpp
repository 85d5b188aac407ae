// PrecomputedStops: everything about a yard that does not depend on who is inside, so that a new plan takes
// milliseconds: the places to stop at, the shots from each, and the drives between them.
#pragma once

#include <vector>

#include "outrider/jobs/guard/arrivals.hpp"
#include "outrider/jobs/guard/plan.hpp"
#include "outrider/tour/problem.hpp"

namespace outrider {

struct PrecomputedStops {
  std::vector<Vec2> stops;      ///< the start first
  TourProblem table;            ///< over the stops; its goals are the targets of the problem
  Routes routes;                ///< between the stops
  std::vector<Visit> tour;      ///< of the plan for the still yard, over the stops
  std::vector<char> reachable;  ///< by target: some stop has a shot at it
};

/// The stops are those of `plan`, the plan of the still yard, and the best of the others (stops.hpp,
/// choose_stops), at most `options.stops` of these. A service takes the flight over the rate of its hits;
/// shots that often miss count only where a target has no other. `besides` stand behind them, without shots.
/// Refused as routes_between().
Outcome<PrecomputedStops> precompute_stops(const GuardProblem& problem, const FiringMap& firing_map,
                                           const GuardPlan& plan, const ArrivalOptions& options,
                                           const Budget& budget, const std::vector<Vec2>& besides = {});

}  // namespace outrider
