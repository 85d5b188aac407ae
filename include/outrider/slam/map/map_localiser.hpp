// MapLocaliser: localisation with a range finder on a known occupancy map, from anywhere.
//
// Not located: scans are matched with each other, and the last of them together are searched on the whole
// map, over the full turn: after 0.5 m, then after ways half as long again, at most 8 m. They are recognised
// where most of their points lie on surfaces, no other pose scores nearly as well, and few beams pass through
// a surface. A robot in a building of equal rooms is not located until it has seen what tells them apart.
//
// Located: each scan is matched with the map in a window about the odometry. How well the scans fit is
// averaged over the last ones. Where they no longer fit, as for a robot that was carried away, the robot is
// lost, and is searched everywhere again. Nothing is assumed about where it went. Scans from within a wall of
// the map, as in a doorway that the map does not have, do not count.
//
// Frames: world_T_robot, where the world is that of the map. Same input, same bytes. Thread rule: one at a
// time. Complexity: a step, the points of a scan and the window; a search, at most some seconds, see
// src/slam/scan/surface_map.hpp. Sources: Fox, Burgard and Thrun, Markov localization for mobile robots in
// dynamic environments, J. Artificial Intelligence Research 11 (1999) 391-427 (the problem); Hess et al.,
// Real-time loop closure in 2D LIDAR SLAM, ICRA 2016, 1271-1278 (the search).
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>

#include "outrider/slam/laser/laser_slam.hpp"

namespace outrider {

/// An occupancy map, with values of Occupancy. It is turned by `yaw_rad` about its origin in the world.
struct KnownMap {
  Grid<std::uint8_t> occupancy;
  double yaw_rad = 0.0;
};

/// The result of a step.
struct MapLocaliserStep {
  Pose2 pose;            ///< estimated world_T_robot; without meaning if not located
  bool located = false;  ///< the pose is known
  bool matched = false;  ///< the scan matched the map
  bool fits = false;     ///< and most of its beams agree with the map
  bool found = false;    ///< the robot was recognised at this step
  bool lost = false;     ///< the robot was located before this step, and is not now
};

class MapLocaliser {
 public:
  /// Begins anywhere, or where the robot is told to be, give or take 0.5 m and 15 degrees. Of the options it
  /// uses `reach_m`, `robot_T_laser` and those of the odometry. Faults: bad_input for options out of range, a
  /// start that is not finite, and a map without a surface or of more than 500 m by 500 m.
  static Outcome<MapLocaliser> begin(KnownMap map, const LaserSlamOptions& options,
                                     const std::optional<Pose2>& start = {});

  MapLocaliser(MapLocaliser&&) noexcept;
  MapLocaliser& operator=(MapLocaliser&&) noexcept;
  ~MapLocaliser();

  /// Advances by one step. `motion` is previous_T_robot by odometry. Fault: bad_input for a motion that is
  /// not finite. A scan that cannot be used is ignored.
  Outcome<MapLocaliserStep> advance(const Pose2& motion, const LaserScan& scan);

  [[nodiscard]] const Pose2& pose() const;
  [[nodiscard]] bool is_located() const;
  /// Returns the covariance of x, y and heading in the world: that of the last match and of the odometry
  /// since, m^2, m rad, rad^2.
  [[nodiscard]] Eigen::Matrix3d pose_covariance() const;
  [[nodiscard]] const KnownMap& map() const;
  /// Returns the pose of the frame in which the cells of the map are not turned.
  [[nodiscard]] const Pose2& world_T_grid() const;

 private:
  struct State;
  explicit MapLocaliser(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace outrider
