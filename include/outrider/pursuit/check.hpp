// check() and certify() verify pursuit plans. They share no code with the planners.
//
// check() verifies that the path begins at the robot's cell, that every step waits or moves to a free
// neighbour, that the target is caught in the last second of the path and not before, that the cost is the
// sum along the path, that the lower bound is at most the cost, and that the earliest catch is not later than
// this one. O(seconds). certify() also proves the lower bound and the earliest catch by a sweep of every cell
// in every second: O(cells seconds), which takes minutes on large maps. The fault names the second.
#pragma once

#include "outrider/core/budget.hpp"
#include "outrider/pursuit/plan.hpp"

namespace outrider {

/// Verifies a plan as described above.
Status check(const PursuitPlan& plan, const PursuitProblem& problem);

/// Verifies a plan, its bound and its earliest catch. Faults: also budget_exhausted and cancelled.
Status certify(const PursuitPlan& plan, const PursuitProblem& problem, const Budget& budget);

}  // namespace outrider
