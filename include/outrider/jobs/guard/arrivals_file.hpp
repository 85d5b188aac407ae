// Entrances and schedules of arrivals, as text.
//
// Entrances: name=x,y in m, with white space between: "gate=0,-7 gap=-9.5,2".
// A schedule has one intruder a line, words key=value in any order; '#' starts a comment:
//     t=12.5 at=garfield by=gate
// t: when it enters, s; at: the target whose place it goes to; by: the entrance. Lines may stand in any
// order of time.
//
// Errors: bad_input with file:line or the key, the word and what would be right.
// Bounds: 1000 intruders, 100 entrances. O(length of the text x names).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "outrider/jobs/guard/arrivals.hpp"

namespace outrider {

/// Refuses an entrance outside `bounds`, by name.
Outcome<std::vector<Entrance>> entrances_from_text(std::string_view text, const Box2& bounds);

Outcome<std::vector<Intruder>> arrivals_from_text(std::string_view text, const std::string& name,
                                                  const GuardProblem& problem,
                                                  const std::vector<Entrance>& entrances,
                                                  const ArrivalOptions& options);

/// The intruders of a scenario: none, those of the schedule, or those of the process with that seed.
/// Names of the policy and the objective are checked.
Outcome<std::vector<Intruder>> load_arrivals(const GuardProblem& problem, const ArrivalOptions& options,
                                             std::uint64_t seed);

}  // namespace outrider
