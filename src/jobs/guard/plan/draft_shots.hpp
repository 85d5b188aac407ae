// Shots that suit the order of a tour: a shot that flies a little longer, but to which the gun gets sooner
// from the one before, may end the tour earlier.
#pragma once

#include "plan/draft.hpp"

namespace outrider {

/// Gives each hit of the draft's tour, in its order, the shot of those found at its stop with which the tour
/// ends soonest. They replace those of the same stops and targets in `offered` and in `book`; the tour gets
/// its new cost and loses its bound. No shot becomes less sure. O(hits x pitches) searches for a shot.
void choose_shots(const GuardProblem& problem, const FiringMap& firing_map, const GuardOptions& options,
                  ShotBook& book, Draft& draft);

}  // namespace outrider
