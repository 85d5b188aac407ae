// Why a target is out of reach, in one sentence.
#pragma once

#include <string>

#include "outrider/jobs/guard/yard/firing_map.hpp"

namespace outrider {

/// For a target whose region is empty: what was tried, at which resolution, and what stands in the way.
std::string why_unreachable(const GuardProblem& problem, const FiringMap& firing_map,
                            const GuardOptions& options, std::size_t target);

}  // namespace outrider
