// Retreat: a robot that makes no progress, or touches something, backs off along its path, and if that does
// not help to where there is most room.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "outrider/control/nearby.hpp"
#include "outrider/jobs/explore/mission/scan_localiser.hpp"
#include "outrider/jobs/explore/mission/task.hpp"

namespace outrider {

class Retreat {
 public:
  /// Counts as progress, here and now.
  void moved_on(const Pose2& pose, double time_s) {
    stood_ = pose;
    moved_on_s_ = time_s;
  }
  /// Notes progress; returns true if there was none for `patience_s`.
  bool stands_still(const Pose2& pose, double time_s, double patience_s);

  /// Counts that the robot is stuck; in a row, unless it has touched something new. Returns how often in a
  /// row.
  std::int64_t count(double driven_m, bool touched_new);
  /// Returns the way on which it backs off: along the one it came, or after that was tried here to where
  /// there is most room.
  std::vector<Vec2> way(const ScanLocaliser& where, const Nearby& nearby, double length_m);

  [[nodiscard]] bool backwards() const { return backwards_; }  ///< it drives backwards while it backs off
  [[nodiscard]] std::int64_t stuck() const { return stuck_; }  ///< how often the robot got stuck
  /// Returns true if it was often stuck right here, so that the newest scan is to be trusted more than the
  /// map.
  [[nodiscard]] bool often_here(double driven_m) const;

 private:
  Pose2 stood_;              ///< pose of the last progress
  double moved_on_s_ = 0.0;  ///< time of the last progress
  bool backwards_ = false;
  std::int64_t stuck_ = 0;
  std::int64_t stuck_here_ = 0;  ///< how often recently
  double stuck_m_ = 0.0;         ///< distance driven at the last time
};

}  // namespace outrider
