// GunSilence: tells a gun that does not shoot from shots that miss.
//
// Nothing comes of a shot of a jammed gun or an empty tank. One shot without a result is tried again, and so
// is a target; but a gun of which nothing has come for long enough, whatever it was aimed at, does not shoot.
// A jam that ends sooner than that costs no target. O(log targets) a shot.
#pragma once

#include <cstddef>
#include <set>
#include <string>

namespace outrider {

/// The shots in a row of which no result came.
struct GunSilence {
  int shots = 0;
  std::set<std::size_t> targets;  ///< at which they were aimed
  double since_s = 0.0;           ///< when the first of them was found to have no result

  /// Notes what came of a shot at a target, or that nothing did.
  void note(std::size_t target, bool has_result, double time_s);

  /// Returns why the gun is not to be tried any more; empty if it is. That is after at least 6 shots without
  /// a result at 2 or more targets, the first at least 30 s ago.
  [[nodiscard]] std::string verdict(double time_s) const;
};

}  // namespace outrider
