// Reference planners: simple methods, as a baseline for the better ones.
//
// All of them choose stops from the cells of the firing map, so their plans are executed like those of
// plan_guard(). None of them considers how robust a shot is against errors. None proves anything: their lower
// bound is 0. Only the last one may serve several targets from one stop, if they happen to be in reach.
#pragma once

#include "outrider/jobs/guard/plan/plan.hpp"

namespace outrider {

/// Takes the first stop found for each target, and orders the stops in groups. It searches circles around the
/// target, from the reach of the gun inwards in steps of 0.5 m, every 15 degrees from the east on, and takes
/// the first place that the robot can reach and shoot from. A target without such a place is unreachable.
/// Targets are served in the order of the list, `group` at a time; within a group the order with the least
/// drive time is taken. O(targets * reach + group! * targets / group), and the drive times between all stops.
/// Source: the method of the reference report (a tank robot with a water gun), from its description.
Outcome<GuardPlan> shrinking_circles(const GuardProblem& problem, const FiringMap& firing_map,
                                     const GuardOptions& options, const Budget& budget,
                                     std::size_t group = 4);

/// Takes the stops of shrinking_circles(), in the best order that the tour solver finds for all targets
/// together.
Outcome<GuardPlan> circles_in_order(const GuardProblem& problem, const FiringMap& firing_map,
                                    const GuardOptions& options, const Budget& budget);

/// Uses a precomputed table of which targets can be hit from which places of a grid of 0.5 m. The robot
/// always goes to the nearest place (in a straight line) from which any remaining target can be hit, and
/// shoots there at the first such target of the list. A target that cannot be hit from any of the places is
/// unreachable. O(targets * cells). Source: the abstract of the reference report, from its description.
Outcome<GuardPlan> source_target_table(const GuardProblem& problem, const FiringMap& firing_map,
                                       const GuardOptions& options, const Budget& budget);

}  // namespace outrider
