// Simultaneous localisation and mapping with a range finder.
//
// Each scan is matched with the map of the scans around it, first by search over a window about the odometry
// (correlative, complete within the window), then by Gauss-Newton to a part of a cell. Places that come again
// are recognised by the same search against old parts of the map, held against chance, and added to a pose
// graph as closed loops; when the graph moves, the map is drawn anew.
//
// Frames: world_T_robot; the first pose is exact. Same input, same bytes. Thread rule: one at a time.
#pragma once

#include <memory>
#include <vector>

#include "outrider/slam/matrix.hpp"
#include "outrider/slam/occupancy_map.hpp"

namespace outrider {

struct LaserSlamOptions {
  bool trust_odometry = false;  ///< poses are those of the odometry: mapping alone
  Pose2 robot_T_laser;
  OccupancyMapOptions map;
};

std::vector<Option> describe(LaserSlamOptions& options);

struct LaserSlamStep {
  Pose2 pose;            ///< now
  bool matched = false;  ///< the scan fitted the map; else the pose is that of the odometry
  bool closed_loop = false;
  MapUpdate update;  ///< of map()
};

class LaserSlam {
 public:
  static Outcome<LaserSlam> begin(const LaserSlamOptions& options, const Pose2& start);

  LaserSlam(LaserSlam&&) noexcept;
  LaserSlam& operator=(LaserSlam&&) noexcept;
  ~LaserSlam();

  /// `motion`: the robot now in its frame at the step before, by odometry. A scan that cannot be used is left
  /// out, and the step is that of the odometry; nothing else is refused than a motion that is not finite.
  Outcome<LaserSlamStep> advance(const Pose2& motion, const LaserScan& scan);

  [[nodiscard]] const Pose2& pose() const;
  [[nodiscard]] Matrix3 pose_covariance() const;
  [[nodiscard]] const OccupancyMap& map() const;
  /// The start and the pose after each step, as known now.
  [[nodiscard]] std::vector<Pose2> trajectory() const;

 private:
  struct State;
  explicit LaserSlam(std::unique_ptr<State> state);
  std::unique_ptr<State> state_;
};

}  // namespace outrider
