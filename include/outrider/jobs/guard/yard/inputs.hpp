// Text formats of guard inputs. Faults are bad_input with file:line or the key, the wrong word and the
// correct form. O(length of the text), times the number of names for schedules and preferences.
//
// Entrances are name=x,y in m, separated by white space: "gate=0,-7 gap=-9.5,2". Stations are name=x,y,kind
// in the same way; the kind is water, charge or both. At most 100 of each. A schedule of arrivals has one
// intruder per line, as key=value words in any order; '#' starts a comment:
//     t=12.5 at=garfield by=gate
// t is the time of entering, s; at is the target to whose place it goes; by is the entrance. The lines need
// not be sorted by time. At most 1000 intruders.
// Recorded positions are CSV with one line t,id,x,y per position, in s and m. The first line may be the
// header "t,id,x,y". The lines of each id must be sorted by time; different ids may alternate. At most
// 1,000,000 lines and 10,000 ids.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "outrider/jobs/guard/yard/arrivals.hpp"
#include "outrider/jobs/guard/yard/wander.hpp"

namespace outrider {

/// Parse entrances and stations. Faults: words of another form, duplicate names, places outside `bounds`.
Outcome<std::vector<Entrance>> entrances_from_text(std::string_view text, const Box2& bounds);
Outcome<std::vector<Station>> stations_from_text(std::string_view text, const Box2& bounds);

/// Parses a schedule of arrivals. `name` stands for the file in faults.
Outcome<std::vector<Intruder>> arrivals_from_text(std::string_view text, const std::string& name,
                                                  const GuardProblem& problem,
                                                  const std::vector<Entrance>& entrances,
                                                  const ArrivalOptions& options);

/// Returns the intruders of a scenario: none, those of the schedule, or a sample of the Poisson process with
/// that seed. Also checks the names of the policy and the objective.
Outcome<std::vector<Intruder>> load_arrivals(const GuardProblem& problem, const ArrivalOptions& options,
                                             std::uint64_t seed);

/// Parses recorded positions. Returns one track for each id, in the order of their first lines.
Outcome<std::vector<Track>> sightings_from_text(std::string_view text, const std::string& name);

/// Returns the weight of each target as a destination, from words "place=weight"; the default is 1. Faults:
/// unknown names, and weights outside 0 to 1e6.
Outcome<std::vector<double>> preferences_from_text(std::string_view text, const std::vector<Target>& targets);

/// Parses the starts of the robots after the first, "x,y,heading; x,y,heading", in m, m and degrees. An empty
/// text has none. Fault: bad_input at `robot_starts`, for a pose that is not valid and for a number of poses
/// other than `robots` - 1.
Outcome<std::vector<Pose2>> parse_starts(const std::string& text, std::int64_t robots);

}  // namespace outrider
