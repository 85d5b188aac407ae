// Stations in a scenario: name=x,y,water or name=x,y,charge or name=x,y,both, in metres, with blanks between.
//
// Bounds: 100 stations. O(text).
#pragma once

#include <string_view>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/geometry/box.hpp"
#include "outrider/jobs/guard/problem.hpp"

namespace outrider {

/// Refuses words of another form, names that stand twice, and places outside the bounds.
Outcome<std::vector<Station>> stations_from_text(std::string_view text, const Box2& bounds);

/// Fills `problem.supplies.stations` from their text. Refused as above.
Status load_stations(GuardProblem& problem);

}  // namespace outrider
