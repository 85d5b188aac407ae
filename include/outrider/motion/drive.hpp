// Drive: how long it takes to get from one place to another, as a table entry.
#pragma once

#include <limits>

namespace outrider {

/// The fastest drive between two places, from rest to rest, without the first turn; an infinite time
/// says that there is none. With time_s = 0 the places are one and the headings mean nothing.
struct Drive {
  double time_s = std::numeric_limits<double>::infinity();
  double departure_rad = 0.0;  ///< heading of the first leg
  double arrival_rad = 0.0;    ///< heading of the last leg
};

}  // namespace outrider
