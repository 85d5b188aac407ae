// Blacklist: goals that failed and are avoided for a while.
//
// A place is banned for `ban_s` seconds after its first failure, and for twice as long after each further
// failure within the same radius. After that it is allowed again. O(places).
#pragma once

#include <vector>

#include "outrider/geometry/vec.hpp"

namespace outrider {

/// A banned place.
struct Ban {
  Vec2 place;
  double until_s = 0.0;  ///< end of the ban
  int failures = 0;      ///< number of failures so far
};

/// All bans.
struct Blacklist {
  double radius_m = 0.3;  ///< places nearer than this count as one
  double ban_s = 30.0;    ///< duration of the first ban
  std::vector<Ban> bans;  ///< in the order of the first failures

  /// Bans a place after a failure.
  void add(Vec2 place, double time_s);
  /// Ends the bans of places that failed fewer than `failures` times. Returns true if there were any.
  bool lift(int failures, double time_s);
  /// Returns the active ban of the place, or null.
  [[nodiscard]] const Ban* find(Vec2 place, double time_s) const;
};

}  // namespace outrider
