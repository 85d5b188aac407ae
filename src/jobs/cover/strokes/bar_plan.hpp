// Tracks of a robot that turns in place and covers with a bar.
//
// Strokes along every edge, as near as the bar may come, then lanes back and forth over what these leave;
// what is still left is driven along the edges the other way round and deeper inside, and swept again. The
// robot moves between strokes where it can turn. Nothing says that all is covered: prove() measures it.
#pragma once

#include "outrider/jobs/cover/strokes/plan.hpp"

namespace outrider::cover {

/// Plans the track. Faults: those of cover_ground(); bad_input where no stroke fits; those of the tour.
Outcome<CoverPlan> bar_plan(const CoverProblem& problem, const CoverOptions& options, const Budget& budget);

}  // namespace outrider::cover
