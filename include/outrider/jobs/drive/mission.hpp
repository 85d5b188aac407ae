// The execution of a drive: a pure step from what a robot on wheels senses to the wheel speeds it commands.
//
// Closed loop, each period: the belief is carried on by dead reckoning to the moment of the newest image and,
// unless that is older than half a period or was used before, fused with what its tags say
// (estimate/localise.hpp); then carried on to now. The follower makes the next command
// for where the robot will be when that takes effect. A stop counts as reached once the robot has stood there
// for `settle` with a belief that is not wide.
//
// Open loop: the motions of control/timed_drive.hpp, one after another; tags are not looked at.
//
// The mission ends with a reason other than success when the belief is lost: its covariance has outgrown
// the limits, or image after image shows tags where they cannot be (somebody has moved the robot); or when
// a waypoint takes longer than the patience. The last command is always to rest, and so is the first, for
// links that lose it.
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
  std::size_t waypoint = 0;
  double time_s = 0.0;
  PoseBelief belief;
};

enum class DriveEnd { none, done, lost, stuck };

struct DriveMission {
  /// The next DriveWheels, or nothing when the mission is over: see `end`. The task has a waypoint, and the
  /// last one is a stop.
  std::optional<Command> step(const Observation& seen);

  DriveTask task;
  Reckoning reckoning;
  Follower follower;
  std::vector<TimedMotion> motions;  ///< of the open loop
  std::size_t motion = 0;            ///< of them, the present one
  double since_s = 0.0;              ///< the way to the present waypoint, or the present motion, has begun
  std::optional<double> resting_since_s;
  double image_s = -std::numeric_limits<double>::infinity();  ///< when the newest one was taken
  double tag_s = 0.0;                                         ///< when one last told where the robot is
  std::int64_t images = 0;                                    ///< that were fresh enough to use
  std::int64_t used = 0;     ///< of these, with a tag that told where the robot is
  std::int64_t refused = 0;  ///< of these, the last ones in a row that told what cannot be
  std::vector<DriveArrival> arrivals;
  bool initial_stop_sent = false;
  DriveEnd end = DriveEnd::none;
  std::string reason;  ///< why it ended without success
};

DriveMission begin(DriveTask task);

}  // namespace outrider
