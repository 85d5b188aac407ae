// A lower bound on the time of every order of laps and cells, however many there are.
//
// Every order gives each unit one unit before it and one after it, and drives it in one of its ways. The
// bound is the cheapest such assignment (Kuhn 1955), in which the units may fall into several rings, and each
// unit may be entered in one way and left in another. A price on each way that is paid on entering it and got
// back on leaving it changes the cost of no order, and prices that rise where a way is left but not entered
// make the bound better (Held and Karp 1971).
#pragma once

#include <stop_token>

#include "outrider/tour/problem.hpp"

namespace outrider::cover {

/// Returns the bound, s, for stops that serve one goal each. Without `started` the first unit is reached for
/// nothing. `aim_s`: prices are changed no longer once the bound is as large. After a stop request, the best
/// bound so far. O(rounds (stops^2 + goals^3)).
double order_bound_s(const TourProblem& problem, bool started, double aim_s,
                     const std::stop_token& stop = {});

}  // namespace outrider::cover
