// tour_bound(): a lower bound of the shortest round through some stops, for many stops.
//
// A round is a spanning tree of all stops but the first, and two edges of that one, in which each stop has
// two edges. Without the last condition the least such graph (a 1-tree) is found at once. A price of each
// stop, added to its edges, changes every round by the same; the prices follow the stops with too many or too
// few edges. Every choice of prices gives a bound. The distances need not obey the triangle inequality.
// O(rounds x stops^2). Source: Held and Karp, The traveling-salesman problem and minimum spanning trees: Part
// II (1971).
#pragma once

#include <cstddef>
#include <vector>

namespace outrider {

/// Symmetric distances between stops, not negative and finite.
using StopDistances = std::vector<std::vector<double>>;

/// Returns the bound of the closed round through the stops with these indices, at least two different ones.
double tour_bound(const StopDistances& distances, const std::vector<std::size_t>& stops, int rounds);

/// Leaves out one stop after another, but the first, as long as that raises the bound: without the triangle
/// inequality it may. Returns the bound of those that are left.
double best_tour_bound(const StopDistances& distances, std::vector<std::size_t>& stops);

}  // namespace outrider
