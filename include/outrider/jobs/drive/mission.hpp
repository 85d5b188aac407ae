// DriveMission executes a drive: a pure step from the observations of a robot on wheels to the wheel speeds
// that it commands.
//
// Closed loop: in each period dead reckoning advances the belief to the time of the newest image. The tags of
// the image correct the belief (estimate/localise.hpp) unless the image is older than half a period or was
// used before. Dead reckoning then advances the belief to the present. The follower computes the next command
// for the pose at which the command takes effect. A stop counts as reached once the robot has stood there for
// `settle_s` with a small uncertainty.
//
// Open loop: the mission executes the motions of control/timed_drive.hpp one after another and ignores tags.
//
// The mission fails if the belief is lost or a waypoint takes longer than the patience. The belief is lost if
// its covariance exceeds the limits, or if several images in a row show tags at impossible places (somebody
// has moved the robot). The first and the last command are to rest, for links that lose commands.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "outrider/control/timed_drive.hpp"
#include "outrider/jobs/drive/task.hpp"
#include "outrider/robot/mission.hpp"

namespace outrider {

/// A stop that was reached.
struct DriveArrival {
  std::size_t waypoint = 0;  ///< its index
  double time_s = 0.0;
  PoseBelief belief;  ///< at that time
};

/// How a mission ended.
enum class DriveEnd { none, done, lost, stuck };

/// The state of the execution.
struct DriveMission {
  /// Returns the next DriveWheels, or nothing if the mission is over: see `end`. The task must have a
  /// waypoint, and the last one must be a stop.
  std::optional<Command> step(const Observation& seen);

  DriveTask task;
  Reckoning reckoning;
  Follower follower;
  std::vector<TimedMotion> motions;  ///< of the open loop
  std::size_t motion = 0;            ///< index of the current motion
  double since_s = 0.0;              ///< start of the path to the current waypoint, or of the current motion
  std::optional<double> resting_since_s;
  double image_s = -std::numeric_limits<double>::infinity();  ///< time of the newest image
  double tag_s = 0.0;                                         ///< time of the last correction by a tag
  std::int64_t images = 0;                                    ///< number of images recent enough to use
  std::int64_t used = 0;                                      ///< images with a tag that corrected the belief
  std::int64_t refused = 0;  ///< number of last images in a row with impossible tags
  std::vector<DriveArrival> arrivals;
  bool initial_stop_sent = false;
  DriveEnd end = DriveEnd::none;
  std::string reason;  ///< why the mission failed
};

/// Starts a mission.
DriveMission begin(DriveTask task);

}  // namespace outrider
