// Simultaneous localisation and mapping with a range finder.
//
// Each scan is matched with the surfaces that the scans around it saw, first by search over a window about
// the odometry (correlative, complete within the window), then by Gauss-Newton to a part of a cell, with the
// odometry as prior: where the walls say nothing, as along a corridor, it decides. A scan is kept every
// key_distance_m or key_turn_rad; kept scans are tied together in a pose graph, to the one before and, where
// their places by each other are well known, to those of earlier visits, with which the next scans are then
// matched too. Places that come again after a long way are recognised by the same search of the last scans
// together against old ones, held against chance (enough points on surfaces, no rival place, the other ties
// give way), and close a loop; when the graph then moves a scan by a cell, the map is drawn anew from the
// kept scans.
//
// Where a scan fits nothing, the pose is that of the odometry, and the tie is loose. The map has every scan
// until it is drawn anew.
//
// Lost: where odometry is off by so much (three standard deviations are more than 3 m: after some 10 m
// without a match, or a jump) that the scan may fit several places, it must be recognised in one, as a loop
// is: most points on surfaces, no rival place. Else, or when the window holds more than a second's work, the
// step says `lost`: the pose is that of the odometry, the covariance grows by its error, and mapping goes on
// from there. Frames: world_T_robot; the first pose is exact. Same input, same bytes. Thread rule: one at a
// time. Complexity: a step, the points of a scan and the window, at most some two seconds; a kept scan,
// besides, the points of some 30 scans; a loop, a solution of the graph. Sources: Olson, Real-time
// correlative scan matching, ICRA 2009, 4387-4393; Konolige et al., Efficient sparse pose adjustment for 2D
// mapping, IROS 2010, 22-29 (the ties); surface_map.hpp in src for the matching.
#pragma once

#include <memory>
#include <vector>

#include "outrider/slam/matrix.hpp"
#include "outrider/slam/occupancy_map.hpp"

namespace outrider {

struct LaserSlamOptions {
  bool trust_odometry = false;  ///< poses are those of the odometry: mapping alone
  bool draw_late = false;       ///< the map is drawn by settle() only
  bool close_loops = true;
  double loop_reach_sd = 2.5;    ///< a place is recognised within so many of the bound's standard deviations
  bool learn_odometry = false;   ///< what it always counts wrong is learnt from the scans
  double reach_m = 30.0;         ///< readings up to here are matched; the map has them all
  double key_distance_m = 0.25;  ///< a scan is kept after this way or turn
  double key_turn_rad = 0.35;
  double odometry_distance = 0.05;               ///< m of error in the root of a metre driven
  double odometry_turn = 0.05;                   ///< rad of error in the root of a radian turned
  double odometry_turn_per_distance_rad = 0.05;  ///< of error in the root of a metre driven
  double odometry_rest_m = 0.005;                ///< of error of a step besides
  double odometry_rest_rad = 0.005;
  Pose2 robot_T_laser;
  OccupancyMapOptions map;
};

std::vector<Option> describe(LaserSlamOptions& options);

struct LaserSlamStep {
  Pose2 pose;            ///< now
  bool matched = false;  ///< the scan fitted the map; else the pose is that of the odometry
  bool lost = false;     ///< the robot may be in several places; what follows is tied to the map loosely
  bool kept = false;     ///< the scan is one that settle() draws the map from
  bool closed_loop = false;
  MapUpdate update;  ///< of map()
};

/// A place that was recognised: two poses of trajectory() that were tied together, by their numbers.
struct LaserLoop {
  std::size_t from = 0;
  std::size_t to = 0;  ///< the later one, when it was recognised
  friend bool operator==(const LaserLoop&, const LaserLoop&) = default;
};

class LaserSlam {
 public:
  /// Refuses options out of their ranges and a start that is not finite.
  static Outcome<LaserSlam> begin(const LaserSlamOptions& options, const Pose2& start);

  LaserSlam(LaserSlam&&) noexcept;
  LaserSlam& operator=(LaserSlam&&) noexcept;
  ~LaserSlam();

  /// `motion`: the robot now in its frame at the step before, by odometry. A scan that cannot be used is left
  /// out, and the step is that of the odometry; nothing else is refused than a motion that is not finite.
  Outcome<LaserSlamStep> advance(const Pose2& motion, const LaserScan& scan);

  /// Brings the poses to the least squares of all that was matched and draws the map anew.
  void settle();

  [[nodiscard]] const Pose2& pose() const;
  /// Of the last scan kept, given the start: (x, y, heading) in the world, an upper bound along the ties that
  /// say most; zeros where odometry is trusted.
  [[nodiscard]] Matrix3 pose_covariance() const;
  [[nodiscard]] const OccupancyMap& map() const;
  /// The start and the pose after each step, as known now.
  [[nodiscard]] std::vector<Pose2> trajectory() const;
  /// Loops closed so far.
  [[nodiscard]] std::size_t loops() const;
  /// The same one by one, in the order of closing.
  [[nodiscard]] std::vector<LaserLoop> closed_loops() const;

 private:
  struct State;
  explicit LaserSlam(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace outrider
