// Observation: what a robot tells a mission. It always has a time and odometry; each device that the robot
// carries adds its part.
//
// Units: m, s, rad, J. Frames: odometry is odom_T_robot; the odometry frame is the robot's start, or the
// world where the robot is localised.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "outrider/estimate/tag.hpp"
#include "outrider/geometry/pose.hpp"
#include "outrider/slam/laser_scan.hpp"
#include "outrider/world/grid.hpp"

namespace outrider {

/// The newest image of a tag camera. An image without tags counts, too.
struct TagImage {
  double taken_s = 0.0;
  std::vector<TagSighting> sightings;
};

/// How the gun points, relative to the body.
struct GunState {
  double yaw_rad = 0.0;
  double pitch_rad = 0.0;
};

/// What became of a shot.
struct ShotResult {
  std::size_t target = 0;
  bool hit = false;
  double landed_s = 0.0;
};

/// How full the stores are; infinite for a store that never runs out.
struct StoreLevels {
  double water = std::numeric_limits<double>::infinity();
  double charge_j = std::numeric_limits<double>::infinity();
};

/// An intruder that walks to a place: it has just entered, or it was hit and stays in the yard.
struct TargetArrival {
  std::size_t target = 0;
  double settles_s = 0.0;  ///< when it is there
  std::size_t place = 0;
};

/// Where a target was seen.
struct TargetObservation {
  std::size_t target = 0;
  double time_s = 0.0;
  Vec2 position;  ///< in the odometry frame
};

/// What a detector of targets tells.
struct TargetReport {
  std::vector<TargetArrival> arrivals = {};  ///< since the observation before
  std::vector<TargetObservation> seen = {};  ///< since then, in the order of time
  bool more_to_come = false;                 ///< somebody may still enter
};

/// A robot team on a grid that pursues a target, one cell a second.
struct GridObservation {
  std::vector<Cell> robots;
  std::vector<Cell> target;  ///< of seconds that are newly known since the observation before, from 0 on
};

struct Observation {
  double time_s = 0.0;
  Pose2 odometry;                            ///< odom_T_robot; the heading need not be wrapped
  std::optional<Pose2> motion = {};          ///< previous_T_robot, where odometry comes in pieces (logs)
  bool touching = false;                     ///< the bumper was pressed since the observation before
  std::optional<LaserScan> scan = {};        ///< taken since the observation before
  std::optional<TagImage> image = {};        ///< the newest one, also when it was seen before
  std::optional<GunState> gun = {};          ///< where there is a gun
  std::vector<ShotResult> shots = {};        ///< that landed since the observation before
  std::optional<StoreLevels> stores = {};    ///< where stores can run out
  std::optional<TargetReport> targets = {};  ///< where there is a detector of targets
  std::optional<GridObservation> grid = {};  ///< of a team on a grid
};

/// The result of a shot at a target; null where none landed.
inline const ShotResult* result_of(const Observation& seen, std::size_t target) {
  for (const ShotResult& shot : seen.shots) {
    if (shot.target == target) return &shot;
  }
  return nullptr;
}

}  // namespace outrider
