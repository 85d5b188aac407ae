// The plan of a guard mission with shots in passing: what can be hit from the way needs no stop.
#pragma once

#include <stop_token>

#include "outrider/jobs/guard/plan.hpp"

namespace outrider {

/// Takes shots off the stops of a plan, one or all of a stop at a time, and puts them on the drives that are
/// left (passing.hpp), as long as that makes the whole mission shorter. A stop without shots is dropped, and
/// the way past it found anew. Never longer than `plan`, by the judge that counted the cost of that.
/// Both lower bounds become moving_bound(): what is proven of a tour holds for shots from rest.
/// A plan over terrain or with stops that fill stores is returned with its hits as they are.
/// Once `stop` is raised no shorter plan is looked for.
/// O(hits^2) assemblies, in each O(stops) routes and the shots that are new.
GuardPlan shoot_in_passing(const GuardProblem& problem, const FiringMap& firing_map, const GuardPlan& plan,
                           const std::stop_token& stop = {});

/// A lower bound on the time of every mission that hits those targets, standing or in passing, from anywhere:
/// the longest of the drives, in a straight line and from rest, that bring each within reach of a ball with
/// the speeds of gun and robot together. 0 in air, where no reach is proven. O(targets).
double moving_bound(const GuardProblem& problem, const FiringMap& firing_map,
                    const std::vector<std::size_t>& targets);

}  // namespace outrider
