// Observation: the sensor data that a robot gives to a mission. An observation always has a time and
// odometry; each device of the robot adds its own part.
//
// Units: m, s, rad, J. Frames: odometry is odom_T_robot. The odometry frame is the start pose of the robot,
// or the world frame if the robot is localised.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "outrider/estimate/tag.hpp"
#include "outrider/geometry/pose.hpp"
#include "outrider/slam/landmark/landmark_log.hpp"
#include "outrider/slam/scan/laser_scan.hpp"
#include "outrider/world/grid.hpp"

namespace outrider {

/// The tags detected in one image of a tag camera; there may be none.
struct TagImage {
  double taken_s = 0.0;  ///< time of exposure
  std::vector<TagSighting> sightings;
};

/// Joint angles of the gun, relative to the robot body.
struct GunState {
  double yaw_rad = 0.0;
  double pitch_rad = 0.0;
};

/// The outcome of one shot.
struct ShotResult {
  std::size_t target = 0;  ///< index of the target that was shot at
  bool hit = false;
  double landed_s = 0.0;  ///< time at which the flight of the ball ended
};

/// Levels of the water tank and the battery. The level of an unlimited store is infinite.
struct StoreLevels {
  double water = std::numeric_limits<double>::infinity();     ///< in the unit of the tank (supplies.hpp)
  double charge_j = std::numeric_limits<double>::infinity();  ///< charge of the battery, J
};

/// Reports that an intruder walks to a place: it has just entered the yard, or it survived a hit and moves.
struct TargetArrival {
  std::size_t target = 0;  ///< index of the intruder
  double settles_s = 0.0;  ///< time at which the intruder reaches the place
  std::size_t place = 0;   ///< index of the place
};

/// One observed position of a target.
struct TargetObservation {
  std::size_t target = 0;
  double time_s = 0.0;
  Vec2 position;  ///< in the odometry frame
};

/// The output of a target detector since the previous observation.
struct TargetReport {
  std::vector<TargetArrival> arrivals = {};  ///< intruders that entered or moved on
  std::vector<TargetObservation> seen = {};  ///< observed positions, in the order of time
  bool more_to_come = false;                 ///< more intruders may still enter
};

/// The state of a robot team that pursues a target on a grid. Robots and target move one cell per second.
struct GridObservation {
  std::vector<Cell> robots;  ///< present cell of each robot
  /// Cells of the target's path that became known since the previous observation, one per second. The first
  /// observation begins with second 0.
  std::vector<Cell> target;
  /// Second of the first of these cells. Unset: they follow those of the observations before.
  std::optional<int> target_from_s = {};
  std::vector<Cell> closed = {};  ///< cells that were found closed since the previous observation
  std::vector<Cell> opened = {};  ///< those that were found open again
  /// True if a robot is in the cell of the target; set if the robots feel it. Unset: the path of the target
  /// decides.
  std::optional<bool> caught = {};
};

struct Observation {
  double time_s = 0.0;
  Pose2 odometry;                            ///< odom_T_robot; the heading may exceed +-pi
  std::optional<Pose2> motion = {};          ///< previous_T_robot, for logs with incremental odometry
  bool touching = false;                     ///< the bumper was pressed since the previous observation
  std::optional<double> touch_rad = {};      ///< bearing of the newest contact, if the bumper tells it
  bool gave_up = false;                      ///< it gave up the drive before: no way leads there
  std::optional<LaserScan> scan = {};        ///< scan taken since the previous observation
  std::optional<LogStep> landmarks = {};     ///< motion and landmarks seen since the previous observation
  std::optional<TagImage> image = {};        ///< newest image, even if an earlier observation had it already
  std::optional<GunState> gun = {};          ///< set if the robot has a gun
  std::vector<ShotResult> shots = {};        ///< shots that ended since the previous observation
  std::optional<StoreLevels> stores = {};    ///< set if water or charge is limited
  std::optional<TargetReport> targets = {};  ///< set if the robot has a target detector
  std::optional<GridObservation> grid = {};  ///< set for a team on a grid
};

/// Returns the result of the shot at `target`, or null if no shot at it ended since the previous observation.
inline const ShotResult* result_of(const Observation& seen, std::size_t target) {
  for (const ShotResult& shot : seen.shots) {
    if (shot.target == target) return &shot;
  }
  return nullptr;
}

}  // namespace outrider
