// Simultaneous localisation and mapping with a range finder.
//
// Front end: each scan is matched with the surfaces of the keyframes around it, first by a correlative search
// that is complete within a window about the odometry, then by Gauss-Newton to a fraction of a cell. Odometry
// is the prior, so it decides where the walls say nothing, as along a corridor. A scan that matches nothing
// gets the pose of the odometry and a weak constraint.
//
// Back end: a scan becomes a keyframe every key_distance_m or key_turn_rad. Constraints of a pose graph join
// it to the keyframe before and, where the relative pose is well known, to one of an earlier visit; the next
// scans are then matched with that visit too. Loop closing matches the last keyframes together with older
// ones and accepts a match if enough points lie on surfaces, no other pose scores nearly as well, and the
// graph still agrees with the constraint. Loops that later scans or loops contradict are undone. If the
// optimised graph moves a keyframe by a cell, the map is redrawn from the keyframes. Until then the map holds
// every scan.
//
// Lost: after a long way without a match, or a jump, three standard deviations of the odometry exceed 3 m,
// and the scan may fit several places. Then it must be recognised in exactly one, by the rules of loop
// closing. If it is not, or if the window holds more than a second's work, the step says `lost`: the pose is
// that of the odometry, the covariance grows by its error, and mapping goes on from there. So it does if a
// scan matches nothing and contradicts the one before, as for a robot that was carried away. The new part is
// searched on the whole map before, again and again while the robot drives on, and joined where its last
// scans together are recognised; no loop is closed between the two before.
//
// Frames: world_T_robot; the first pose is exact. Same input, same bytes. Thread rule: one at a time.
// Complexity: a step, the points of a scan and the window, at most about two seconds; a keyframe, also the
// points of some 30 scans and the poses of the k keyframes before, O(k log k); a loop, one optimisation of
// the graph. Sources: Olson, Real-time correlative scan matching, ICRA 2009, 4387-4393; Konolige et al.,
// Efficient sparse pose adjustment for 2D mapping, IROS 2010, 22-29 (the graph);
// src/slam/scan/surface_map.hpp (the matching).
#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "outrider/slam/graph/pose_graph.hpp"
#include "outrider/slam/map/map_check.hpp"
#include "outrider/slam/map/occupancy_map.hpp"
#include "outrider/slam/map/odometry_ratio.hpp"
#include "outrider/slam/map/range_check.hpp"

namespace outrider {

/// Options of laser SLAM.
struct LaserSlamOptions {
  bool trust_odometry = false;      ///< mapping with known poses: no scan matching
  bool draw_late = false;           ///< draw the map in settle() only
  bool close_loops = true;          ///< search for loops and close them
  double loop_reach_sd = 6.0;       ///< reject loops farther off than this many standard deviations
  bool learn_odometry = false;      ///< estimate the systematic errors of the odometry from the scans
  double reach_m = 30.0;            ///< longer readings are mapped, not matched
  double key_distance_m = 0.25;     ///< distance after which a scan becomes a keyframe
  double key_turn_rad = 0.35;       ///< rotation after which a scan becomes a keyframe
  double odometry_distance = 0.05;  ///< standard deviation, m after 1 m driven; grows with the root
  double odometry_turn = 0.05;      ///< standard deviation, rad after 1 rad turned
  double odometry_turn_per_distance_rad = 0.05;  ///< standard deviation of the heading after 1 m driven
  double odometry_rest_m = 0.005;                ///< standard deviation added in each step
  double odometry_rest_rad = 0.005;              ///< standard deviation of the heading added in each step
  Pose2 robot_T_laser;
  OccupancyMapOptions map;
};

std::vector<Option> describe(LaserSlamOptions& options);

/// The result of a step.
struct LaserSlamStep {
  Pose2 pose;                   ///< estimated world_T_robot after the step
  bool matched = false;         ///< the scan matched; otherwise the pose is that of the odometry
  bool lost = false;            ///< the robot is lost; see the head of this file
  bool kept = false;            ///< the scan became a keyframe
  bool is_known_place = false;  ///< the keyframe is from a place that was seen many times
  bool closed_loop = false;     ///< a loop was closed or undone, or a gap was bridged: poses moved
  bool undid_loop = false;      ///< a loop was undone, because later scans or loops contradict it
  MapUpdate update;             ///< changes of map()
};

/// A loop constraint between two poses of trajectory(), by their numbers.
struct LaserLoop {
  std::size_t from = 0;
  std::size_t to = 0;  ///< the later one, at which the loop was closed
  friend bool operator==(const LaserLoop&, const LaserLoop&) = default;
};

/// Laser SLAM as described above.
class LaserSlam {
 public:
  /// Begins at a start pose. Fault: bad_input for options out of range and for a start that is not finite.
  static Outcome<LaserSlam> begin(const LaserSlamOptions& options, const Pose2& start);

  LaserSlam(LaserSlam&&) noexcept;
  LaserSlam& operator=(LaserSlam&&) noexcept;
  ~LaserSlam();

  /// Advances by one step. `motion` is previous_T_robot by odometry. Fault: bad_input for a motion that is
  /// not finite. A scan that cannot be used is ignored.
  Outcome<LaserSlamStep> advance(const Pose2& motion, const LaserScan& scan);

  /// Optimises the graph of all constraints and redraws the map.
  void settle();

  [[nodiscard]] const Pose2& pose() const;
  /// Returns the covariance of the last keyframe relative to the start, of (x, y, heading) in the world: its
  /// marginal in the graph of all constraints, for odometry whose errors are as stated or learnt. Zero with
  /// `trust_odometry`.
  [[nodiscard]] Eigen::Matrix3d pose_covariance() const;
  [[nodiscard]] const OccupancyMap& map() const;
  /// Returns the start and the pose after each step, as presently estimated.
  [[nodiscard]] std::vector<Pose2> trajectory() const;
  /// Returns the graph that the map is made of: its keyframes, named by their steps, which count from 0, and
  /// all constraints between them. Empty with `trust_odometry`.
  [[nodiscard]] PoseGraph pose_graph() const;
  /// Returns the number of loops closed so far.
  [[nodiscard]] std::size_t loops() const;
  /// Returns the loops in the order in which they were closed.
  [[nodiscard]] std::vector<LaserLoop> closed_loops() const;
  /// Returns the number of places that were recognised and not believed.
  [[nodiscard]] std::size_t loops_refused() const;
  /// Returns the number of loops that were closed and undone, because later scans or loops contradicted them.
  [[nodiscard]] std::size_t loops_undone() const;
  /// Returns the poses that only odometry joins to the ones before, because their scan matched nothing and no
  /// later match spans the gap.
  [[nodiscard]] std::vector<std::size_t> gaps() const;
  /// Checks whether the scans of the keyframes agree on what is free, whether odometry or scans confirm each
  /// step from one keyframe to the next, and whether the path leads through what map() shows as occupied;
  /// numbers are those of trajectory().
  [[nodiscard]] MapCheck check() const;
  /// Checks whether the scans of the keyframes speak for the range finder.
  [[nodiscard]] RangeCheck check_range_finder() const;
  /// Compares the path with what odometry counted; see odometry_ratio.hpp.
  [[nodiscard]] OdometryRatio odometry_ratio() const;

 private:
  struct State;
  [[nodiscard]] std::vector<PlacedScan> placed_scans() const;
  explicit LaserSlam(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace outrider
