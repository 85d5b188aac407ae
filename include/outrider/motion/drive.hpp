// Drive: time and end headings of a drive between two places, as an entry of a table.
#pragma once

#include <limits>

namespace outrider {

/// The fastest drive between two places, from rest to rest, without the first turn; an infinite time means
/// that there is none. If `time_s` is 0, start and end are the same place and the headings are unspecified.
struct Drive {
  double time_s = std::numeric_limits<double>::infinity();
  double departure_rad = 0.0;  ///< heading of the first leg
  double arrival_rad = 0.0;    ///< heading of the last leg
};

}  // namespace outrider
