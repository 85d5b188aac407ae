// NavigationLog logs what a robot sees that its navigator drives: its scans, and once a second what is marked
// on its live map. Thread rule: one at a time.
#pragma once

#include "outrider/log/log.hpp"
#include "outrider/navigate/live_map.hpp"
#include "outrider/robot/observation.hpp"

namespace outrider {

class NavigationLog {
 public:
  /// The log must outlive this object.
  explicit NavigationLog(Log& log) : log_(&log) {}

  /// Call it at each period of the navigator. O(cells of the map) once a second.
  void note(const Observation& seen, double time_s, const LiveMap& map);

 private:
  Log* log_;
  double next_map_s_ = 0.0;
};

}  // namespace outrider
