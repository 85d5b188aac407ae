// Tracks of a robot with a turning radius: the strokes of one field, joined by turns, in the quickest order
// found.
#pragma once

#include "outrider/jobs/cover/strokes/plan.hpp"

namespace outrider::cover {

/// The strokes that are tried: lanes within a headland of `problem.headland` laps, or of some numbers of
/// laps; laps inwards as far as there are any; or both.
enum class TurningMethod { lanes, laps, both };

/// Plans a track without a turn in place: of those tried, the one that leaves least and then takes least
/// time. Strokes that no way leads to, or none leads on from, are left out. Faults: those of cover_ground();
/// bad_input where no stroke fits; start_blocked where no way leads from the start; those of the tour.
Outcome<CoverPlan> turning_plan(const CoverProblem& problem, const CoverOptions& options,
                                const Budget& budget, TurningMethod method);

}  // namespace outrider::cover
