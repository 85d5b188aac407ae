// Clocks that measure computing time. Their values are only displayed: no result depends on them.
#pragma once

namespace outrider {

/// Returns the time of a monotonic clock, s.
double wall_s();

/// Returns the processor time used by the calling thread, s.
double processor_s();

}  // namespace outrider
