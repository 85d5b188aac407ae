// Blacklist: places that did not work out, avoided for a while.
//
// A place is out for `ban_s` seconds after its first failure, for twice as long after each further one within
// the same radius, and then has its chance again. O(places).
#pragma once

#include <vector>

#include "outrider/geometry/vec.hpp"

namespace outrider {

struct Ban {
  Vec2 place;
  double until_s = 0.0;
  int failures = 0;
};

struct Blacklist {
  double radius_m = 0.3;  ///< places nearer than this are one
  double ban_s = 30.0;
  std::vector<Ban> bans;

  void add(Vec2 place, double time_s);
  /// The ban in force there, or null.
  [[nodiscard]] const Ban* find(Vec2 place, double time_s) const;
};

}  // namespace outrider
