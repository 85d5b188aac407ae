// Recorded positions of intruders, as text: CSV with a line t,id,x,y for each, in s and m.
//
// The first line may be the heading "t,id,x,y". Lines of one id stand in the order of time; different ids may
// alternate. '#' starts a comment.
// Errors: bad_input with file:line, what is wrong and what would be right. Bounds: 1,000,000 lines, 10,000
// ids.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "outrider/jobs/guard/wander.hpp"

namespace outrider {

/// One track for each id, in the order of their first lines.
Outcome<std::vector<Track>> sightings_from_text(std::string_view text, const std::string& name);

/// The weight of each target as a place to go to, of "place=weight" words; the others weigh 1. Refuses
/// unknown names and weights that are not from 0 to 1e6.
Outcome<std::vector<double>> preferences_from_text(std::string_view text, const std::vector<Target>& targets);

}  // namespace outrider
