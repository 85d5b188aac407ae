// PlaceSearch: where a robot goes that does not know where it is on its map, until it recognises the place:
// to places that it sees a free way to, far from those from which it has looked.
//
// Frames: any in which the odometry is believed. Thread rule: one at a time. O(ways * (beams + places)) for a
// place.
#pragma once

#include <optional>
#include <vector>

#include "outrider/geometry/pose.hpp"
#include "outrider/slam/scan/laser_scan.hpp"

namespace outrider {

class PlaceSearch {
 public:
  /// Forgets all places.
  void begin();
  /// Notes what the robot sees.
  void look(const LaserScan& scan, const Pose2& world_T_laser);
  /// Notes that the robot moved, or stood, for a time; a search ends after a while in either case.
  void advance(double speed_mps, double duration_s);
  /// Returns the place to look from next; nothing if there is no free way with so much room beside it, where
  /// a turn may show one. The robot counts as having looked from here.
  std::optional<Vec2> next(Vec2 here, double room_m);

  /// Returns true if it has seen something since it began.
  [[nodiscard]] bool looks() const { return scan_.has_value(); }
  /// Returns the length of the search, m; standing counts as 0.1 m/s.
  [[nodiscard]] double length_m() const { return length_m_; }

 private:
  [[nodiscard]] double free_m(double bearing_rad) const;

  std::optional<LaserScan> scan_;
  Pose2 world_T_laser_;
  std::vector<Vec2> visited_;
  double length_m_ = 0.0;
};

}  // namespace outrider
