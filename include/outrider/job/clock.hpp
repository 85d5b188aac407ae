// Clocks, for how long the machine took. What they tell is shown and never stored, and decides nothing.
#pragma once

namespace outrider {

/// Passed on a clock that never goes back, s.
double wall_s();

/// Spent by this thread alone, s: nothing else of the program counts.
double processor_s();

}  // namespace outrider
