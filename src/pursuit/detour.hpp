// The best detour: of all catches that go as cheaply as can be to some cell, wait there, and go on as cheaply
// as can be to the target, the cheapest one.
//
// Both ways are read from floods that ignore the clock, so a detour for each cell is known at once, with its
// seconds to spare. O(cells).
#pragma once

#include <optional>

#include "bounds/forward_bound.hpp"
#include "bounds/relaxation.hpp"

namespace outrider {

/// Returns the cheapest such way. Both floods must have run, `forward` from the start of the field. Returns
/// nothing if no detour is in time.
std::optional<TimedWay> best_detour(const PursuitField& field, const ForwardBound& forward,
                                    const Relaxation& backward);

}  // namespace outrider
