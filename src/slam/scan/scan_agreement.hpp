// Agreement tells whether two scans of one place agree on what is free.
//
// A point that one scan hit must not lie where the other one looked through. The comparison uses the raw
// ranges and the two poses only, so it judges matches and maps that were made in other ways. Source: Lu and
// Milios, Robot pose estimation in unknown environments by matching 2D range scans, J. Intelligent and
// Robotic Systems 18 (1997) 249-275 (a scan projected into the polar frame of another, and its visibility).
#pragma once

#include <cstddef>

#include "outrider/geometry/pose.hpp"
#include "outrider/slam/scan/laser_scan.hpp"

namespace outrider {

/// The judgement of one scan about the points of another one. Points that it cannot see are not counted.
struct Agreement {
  std::size_t agreeing = 0;      ///< it has a hit near the point
  std::size_t seen_through = 0;  ///< all its beams around the point go far beyond

  [[nodiscard]] std::size_t seen() const { return agreeing + seen_through; }
  /// Returns the share of the points that it saw through; 0 if it sees none.
  [[nodiscard]] double contradiction() const {
    return seen() == 0 ? 0.0 : static_cast<double>(seen_through) / static_cast<double>(seen());
  }
  Agreement& operator+=(const Agreement& other) {
    agreeing += other.agreeing;
    seen_through += other.seen_through;
    return *this;
  }
};

/// Asks `by` about the points of `of`. A point may be off by `off_m` and by 0.02 rad without being
/// contradicted, so thin things that moved do not count. Asks about 180 to 359 points of a scan with more
/// beams. Expects scans that check() accepts. O(beams of both).
Agreement agreement(const LaserScan& of, const Pose2& world_T_of, const LaserScan& by,
                    const Pose2& world_T_by, double off_m = 0.3);

/// Asks both scans about each other.
inline Agreement mutual_agreement(const LaserScan& a, const Pose2& world_T_a, const LaserScan& b,
                                  const Pose2& world_T_b, double off_m = 0.3) {
  Agreement sum = agreement(a, world_T_a, b, world_T_b, off_m);
  sum += agreement(b, world_T_b, a, world_T_a, off_m);
  return sum;
}

}  // namespace outrider
