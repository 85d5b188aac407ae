// Keeping clear: a robot that does not move as commanded stops before it touches what it knows.
//
// A follower feeds back where the robot is, not what is beside its way. With a wheel that hardly turns the
// robot leaves its way by more than the way is clear. So each command is held back if the place where the
// robot would come to rest after it is nearer to an obstacle than a part of the margin of its legs, and
// nearer than the robot is now. The clearance of the legs less 30 mm is left to the follower, which needs it
// at corners.
#pragma once

#include "outrider/jobs/drive/mission/mission.hpp"

namespace outrider {

/// Returns true if the robot must stop instead of executing the twist, from the pose at which that would take
/// effect. O(obstacles nearby).
bool must_stop(DriveMission& mission, const Pose2& believed, const Twist2& twist);

/// Returns why the robot gives up after it had to stop for too long; empty if it goes on.
std::string why_off_its_way(const DriveMission& mission);

}  // namespace outrider
