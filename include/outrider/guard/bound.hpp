// A lower bound on the time of a guard mission that holds for every choice of places and order.
#pragma once

#include "outrider/guard/site.hpp"

namespace outrider {

/// No mission that hits all targets of the site's regions, each from a cell of its region, takes less.
/// The places from which some of the targets are hit are visited in some order, and a drive of length d
/// takes at least duration(d); so driving costs at least the shortest path from the start that visits
/// each region of any selection once, over the least straight-line distances between regions. The
/// selection is made of up to 12 regions that lie far apart, its shortest path is found by subsets (Held
/// and Karp 1962), and the best of its prefixes counts. To it comes, for each target, the shortest time
/// in which a ball can cross the gap. Turning, aiming and detours around obstacles are not counted.
/// O(targets^2 x cells + 2^12).
double mission_bound(const GuardProblem& problem, const Site& site);

}  // namespace outrider
