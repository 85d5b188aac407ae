// The picture of firing regions: from where how many targets, and from where each of them, can be hit.
#pragma once

#include <string>

#include "outrider/jobs/guard/firing_map.hpp"

namespace outrider {

/// A self-contained SVG: a heat map of the yard, coloured by how many targets can be hit from each place that
/// can be driven to, and a small map for each target, coloured by the error_ratio of its shot. Small maps
/// have fields of at least 1/80 of the yard, the best place of each counts.
std::string regions_svg(const GuardProblem& problem, const FiringMap& firing_map);

}  // namespace outrider
