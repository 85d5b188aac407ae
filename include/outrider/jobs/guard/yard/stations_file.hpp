// The text format of stations in a scenario: name=x,y,kind in metres, separated by blanks. The kind is water,
// charge or both.
//
// Bounds: 100 stations. O(text).
#pragma once

#include <string_view>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/geometry/box.hpp"
#include "outrider/jobs/guard/problem.hpp"

namespace outrider {

/// Parses stations. Faults: words of another form, duplicate names, and positions outside the bounds.
Outcome<std::vector<Station>> stations_from_text(std::string_view text, const Box2& bounds);

/// Sets `problem.supplies.stations` from `problem.supplies.stations_text`. Faults: those of
/// stations_from_text().
Status load_stations(GuardProblem& problem);

}  // namespace outrider
