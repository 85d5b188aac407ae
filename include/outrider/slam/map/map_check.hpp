// check_map(): do the scans of a map agree on what is free?
//
// The check asks each scan about the points of others that were taken near it: the scans just before it, and
// the nearest one of each earlier visit. Where the map is right, a point that one scan hit is seldom one that
// another looked through; people and doors make a few. Where the map is folded or a wall stands twice, most
// points are. It knows poses and ranges only, so it is independent of how the poses were found.
//
// A scan is contradicted if another one looked through more than `most_share` of at least `least_points` of
// its points, or the reverse. What no two scans saw is not checked.
// Complexity: O(scans^2) distances and O(beams) for each of at most ten pairs per scan. Thread rule: pure.
#pragma once

#include <span>
#include <vector>

#include "outrider/geometry/pose.hpp"
#include "outrider/slam/scan/laser_scan.hpp"

namespace outrider {

struct PlacedScan {
  const LaserScan* scan = nullptr;
  Pose2 world_T_laser;
  double way_m = 0.0;    ///< driven up to here
  std::size_t pose = 0;  ///< its number, for the report
};

/// Two scans that contradict each other, by their numbers.
struct Contradiction {
  std::size_t earlier = 0;
  std::size_t later = 0;
  double share = 0.0;  ///< of the points that both saw, one looked through
};

/// A step of the path that neither odometry nor scans confirm: the two differ by more than the error of the
/// odometry, or it follows a pause, and the scans before and after it show too few surfaces in common.
struct Jump {
  std::size_t before = 0;  ///< its poses, by their numbers
  std::size_t after = 0;
  Pose2 by_map;  ///< before_T_after
  Pose2 by_odometry;
  double shared = 0.0;  ///< share of the points of one scan that lie on a surface of the other
  /// Time without a scan, if only this speaks against the step; it means nothing if the clock is wrong.
  double pause_s = 0.0;
  /// Standard deviation of the odometry, if it is too large to tell places apart; else 0.
  double odometry_sd_m = 0.0;
};

struct MapCheck {
  std::size_t scans = 0;         ///< that share points with another
  std::size_t contradicted = 0;  ///< of these
  /// For each scan that is contradicted by earlier ones, the pair with the largest share, in order.
  std::vector<Contradiction> contradictions;
  std::vector<Jump> jumps;  ///< in order; check_map() finds none, since it knows no odometry
  /// Numbers of the poses to which the path leads through what the map shows as occupied; check_map() finds
  /// none, since it knows no map.
  std::vector<std::size_t> crossings;
};

/// Checks scans in the order in which they were taken. Expects scans that check() accepts.
MapCheck check_map(std::span<const PlacedScan> scans);

}  // namespace outrider
