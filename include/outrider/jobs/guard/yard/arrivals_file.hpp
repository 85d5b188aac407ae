// Text formats of entrances and of arrival schedules.
//
// Entrances are name=x,y in m, separated by white space: "gate=0,-7 gap=-9.5,2".
// A schedule has one intruder per line, as key=value words in any order; '#' starts a comment:
//     t=12.5 at=garfield by=gate
// t is the time of entering, s; at is the target to whose place it goes; by is the entrance. The lines need
// not be sorted by time.
//
// Faults: bad_input with file:line or the key, the wrong word and the correct form.
// Bounds: 1000 intruders, 100 entrances. O(length of the text x names).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "outrider/jobs/guard/yard/arrivals.hpp"

namespace outrider {

/// Parses entrances. Fault: bad_input for a wrong word, or for an entrance outside `bounds`, with its name.
Outcome<std::vector<Entrance>> entrances_from_text(std::string_view text, const Box2& bounds);

/// Parses a schedule. `name` stands for the file in faults.
Outcome<std::vector<Intruder>> arrivals_from_text(std::string_view text, const std::string& name,
                                                  const GuardProblem& problem,
                                                  const std::vector<Entrance>& entrances,
                                                  const ArrivalOptions& options);

/// Returns the intruders of a scenario: none, those of the schedule, or a sample of the Poisson process with
/// that seed. Also checks the names of the policy and the objective.
Outcome<std::vector<Intruder>> load_arrivals(const GuardProblem& problem, const ArrivalOptions& options,
                                             std::uint64_t seed);

}  // namespace outrider
