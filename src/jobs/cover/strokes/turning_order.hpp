// The order of strokes: a tour whose drives are the ways of a roadmap.
#pragma once

#include "strokes/turning_strokes.hpp"

namespace outrider::cover {

/// Joins as many of the strokes as lead to each other. Sets track, roles, begins, laps, cells (here: lanes),
/// lanes and the bound.
Outcome<CoverPlan> ordered_strokes(const std::vector<Stroke>& strokes, const CoverProblem& problem,
                                   const TourOptions& options, const FreeRoom& room, const Budget& budget);

}  // namespace outrider::cover
