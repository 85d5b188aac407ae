// check: an independent judge of pursuit plans. Shares nothing with the planners.
//
// Verifies that the path begins with the robot, that every step goes to a neighbour or waits and keeps
// off walls, that the target is caught in the last second of the path and not before, that the cost is
// the sum along it, that the lower bound is not above it, and that no catch is claimed to be possible
// after this one. O(seconds). certify() also proves the bound and the earliest catch by a sweep of every
// cell in every second: O(cells seconds), minutes on large maps. The fault names the second.
#pragma once

#include "outrider/core/budget.hpp"
#include "outrider/pursuit/plan.hpp"

namespace outrider {

Status check(const PursuitPlan& plan, const PursuitProblem& problem);

Status certify(const PursuitPlan& plan, const PursuitProblem& problem, const Budget& budget);

}  // namespace outrider
