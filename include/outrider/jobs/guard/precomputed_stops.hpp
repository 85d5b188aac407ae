// PrecomputedStops: the stops of a yard, the shots from each stop and the drives between them. They do not
// depend on the intruders inside, so they are computed once, and a new plan takes milliseconds.
#pragma once

#include <vector>

#include "outrider/jobs/guard/arrivals.hpp"
#include "outrider/jobs/guard/plan.hpp"
#include "outrider/tour/problem.hpp"

namespace outrider {

/// The result of precompute_stops().
struct PrecomputedStops {
  std::vector<Vec2> stops;      ///< positions; the start comes first
  TourProblem table;            ///< the tour problem over the stops; its goals are the targets
  Routes routes;                ///< between the stops
  std::vector<Visit> tour;      ///< the tour of the plan for still targets
  std::vector<char> reachable;  ///< by target: at least one stop has a shot at it
  bool on_the_move = false;     ///< as the plan (GuardPlan): services with sure shots take no time
};

/// Computes the stops. They are the stops of `plan`, a plan for still targets, and up to `options.stops`
/// further ones by choose_stops() (stops.hpp). The time of a service is the flight time divided by the hit
/// rate; if `plan` is on the move, 0 for shots that hit for sure. Shots that often miss are used only for
/// targets that have no other shots. The places `besides` are added at the end, without shots. Faults: those
/// of routes_between().
Outcome<PrecomputedStops> precompute_stops(const GuardProblem& problem, const FiringMap& firing_map,
                                           const GuardPlan& plan, const ArrivalOptions& options,
                                           const Budget& budget, const std::vector<Vec2>& besides = {});

}  // namespace outrider
