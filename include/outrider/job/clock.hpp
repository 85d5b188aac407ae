// Clocks. Computing times are only displayed: no result depends on them. The time of day is for nodes that
// exchange messages with others.
#pragma once

namespace outrider {

/// Returns the time of a monotonic clock, s.
double wall_s();

/// Returns the time of day as seconds since 1970.
double day_s();

/// Returns the processor time used by the calling thread, s.
double processor_s();

}  // namespace outrider
