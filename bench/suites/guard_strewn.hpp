// A yard for the suite `guard` that is as large as one likes: boxes and targets at random places.
#pragma once

#include <cstdint>

#include "outrider/jobs/guard/problem.hpp"

namespace outrider::bench {

/// Returns a square yard with a wall round it, `targets` targets and as many boxes of 0.2 to 1.5 m, none of
/// which stands in another or on a target; 10 square metres for each target. The robot starts in the middle.
/// The same number gives the same yard.
GuardProblem strewn_yard(std::int64_t targets);

}  // namespace outrider::bench
