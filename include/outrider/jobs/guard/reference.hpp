// Reference methods: simple ways to guard a yard, to show what the better ones are worth.
//
// All of them choose among the cells of the firing_map, so their plans go through the same execution as those
// of plan_guard(). None of them asks whether a shot forgives errors, none proves anything (their lower bound
// is 0), and only the last serves several targets from one stop, when they happen to be in reach.
#pragma once

#include "outrider/jobs/guard/plan.hpp"

namespace outrider {

/// First found, in groups. Around each target circles are searched, from the reach of the gun inwards by 0.5
/// m, every 15 degrees from the east on; the first place there that the robot can get to and shoot from is
/// taken. The targets are served as they are listed, `group` at a time: of all orders of a group the one with
/// the least drive time is taken. A target without such a place on any circle is unreachable. O(targets x
/// reach + group! x targets / group) and the drive times between all places. Source: the method of the
/// reference report (a tank robot with a water gun), from its description.
Outcome<GuardPlan> shrinking_circles(const GuardProblem& problem, const FiringMap& firing_map,
                                     const GuardOptions& options, const Budget& budget);

/// The same places, in the order that the tour solver finds best for all targets together.
Outcome<GuardPlan> circles_in_order(const GuardProblem& problem, const FiringMap& firing_map,
                                    const GuardOptions& options, const Budget& budget);

/// A table made beforehand, of which targets can be hit from which places of a grid of 0.5 m, is looked up:
/// always the nearest place, as the crow flies, from where some target that is left can be hit; there the
/// target listed first. A target that is hit from none of these places is unreachable. O(targets x cells).
/// Source: the abstract of the reference report, from its description.
Outcome<GuardPlan> source_target_table(const GuardProblem& problem, const FiringMap& firing_map,
                                       const GuardOptions& options, const Budget& budget);

}  // namespace outrider
