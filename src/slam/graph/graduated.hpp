// Finds the edges of a pose graph that contradict the others.
//
// Graduated non-convexity with truncated least squares (Yang, Antonante, Tzoumas and Carlone, IEEE RA-L 5
// (2020) 1127-1134, section IV-B) minimises the sum of min(r^T W r, c^2) over the edges that may be refused,
// plus r^T W r of the odometry. A control parameter makes the truncated loss from convex ever steeper; at
// each value the weights have a closed form and the poses a few steps of the trust region.
//
// An edge alone can bend a soft graph until all errors are small, its own too. So the result is then judged
// edge by edge: by how much the cost would fall without the edge, or rise with it.
#pragma once

#include <cstdint>

#include "graph/trust_region.hpp"

namespace outrider {

/// Returns true for each edge that may be refused: all but the odometry, which are the edges between two
/// poses that follow each other in the file.
template <class Pose>
std::vector<bool> refusable_edges(const PoseGraphOf<Pose>& graph);

/// Returns one flag for each edge: refused by graduated non-convexity from these poses, which it moves.
template <class Pose>
std::vector<bool> graduated_refusals(const PoseGraphOf<Pose>& graph, std::vector<Pose>& poses,
                                     std::int64_t iterations, BudgetMeter& meter);

/// Returns how much each refused edge would raise the cost, and each other edge lowers it by its absence, to
/// first order: r^T (W^-1 + C)^-1 r and r^T (W^-1 - C)^-1 r, with C the covariance of the edge as the kept
/// edges predict it. 0 for the odometry and where nothing but the edge determines its error. `poses` are
/// those of least cost for the edges kept.
template <class Pose>
std::vector<double> cost_changes(const PoseGraphOf<Pose>& graph, const std::vector<Pose>& poses,
                                 const std::vector<bool>& refused);

/// Returns the value of chi-square with that many degrees of freedom at so many standard deviations of a
/// normal distribution (Wilson and Hilferty, PNAS 17 (1931) 684-688). 3.09: exceeded once in a thousand
/// times.
double largest_cost(double freedom, double deviations = 3.09);

}  // namespace outrider
