// TimedPath: the fastest motion along waypoints to the next stop, as poses over time.
//
// The legs are straight and their corners rounded (rounded_path.hpp): each by at most 0.7 of its room, the
// rest of it is left for errors. Along that path the motion is time-optimal under the limits of the follower
// and of the wheels (speed_profile.hpp). At a corner of more than 120 degrees, or without room, the robot
// comes to rest. A robot in the manner rotate_then_go turns in place towards the path, points along it, and
// turns in place to the heading of the stop. A holonomic robot turns on the way, as fast as it can; poses do
// not show that. O(length); O(log length) for a pose.
#pragma once

#include <vector>

#include "outrider/control/follow_options.hpp"
#include "outrider/control/rounded_path.hpp"
#include "outrider/control/speed_profile.hpp"
#include "outrider/motion/profile.hpp"

namespace outrider {

/// A motion from rest to rest: along a path, or a turn in place if that is empty.
struct TimedPathSection {
  double start_s = 0.0;
  double duration_s = 0.0;
  Pose2 from;
  double turn_rad = 0.0;
  Limits turning;  ///< of the turn in place
  std::vector<PathPoint> path;
  SpeedProfile profile;
};

struct TimedPath {
  std::vector<TimedPathSection> sections;  ///< at least one
  double duration_s = 0.0;
};

/// Returns the timed path from a pose, at rest, through waypoints `first` and so on to the next stop.
TimedPath timed_path_to_stop(const Pose2& start, const std::vector<Waypoint>& waypoints, std::size_t first,
                             const FollowOptions& options, const Chassis& chassis);

/// Returns the pose at a time; at rest before the start and behind the end.
Pose2 pose_at(const TimedPath& motion, double time_s);

/// Returns the least time of a course, s: from stop to stop the duration of the timed path, or the least time
/// of the turn if the robot turns on the way and that takes longer, and `pause_s` at each stop. No robot that
/// keeps the limits of `options` and of the wheels drives the rounded legs faster.
double ideal_time_s(const Pose2& start, const std::vector<Waypoint>& waypoints, const FollowOptions& options,
                    const Chassis& chassis, double pause_s);

}  // namespace outrider
