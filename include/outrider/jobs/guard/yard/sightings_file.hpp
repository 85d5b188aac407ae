// The text format of recorded positions of intruders: CSV with one line t,id,x,y per position, in s and m.
//
// The first line may be the header "t,id,x,y". The lines of each id must be sorted by time; different ids may
// alternate. '#' starts a comment.
// Faults: bad_input with file:line, the error and the correct form. Bounds: 1,000,000 lines, 10,000 ids.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "outrider/jobs/guard/yard/wander.hpp"

namespace outrider {

/// Returns one track for each id, in the order of their first lines. `name` stands for the file in faults.
Outcome<std::vector<Track>> sightings_from_text(std::string_view text, const std::string& name);

/// Returns the weight of each target as a destination, from words "place=weight"; the default is 1. Faults:
/// unknown names, and weights outside 0 to 1e6.
Outcome<std::vector<double>> preferences_from_text(std::string_view text, const std::vector<Target>& targets);

}  // namespace outrider
