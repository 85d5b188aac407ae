// Looking round: a robot at a stop that one tag alone tells turns until it sees a second one.
//
// A single tag that corrects a wide belief may have been moved, and nothing contradicts it. So the robot
// turns in place, to where by its map another tag tells the position soonest: a tag that is near, and not
// seen from the front, does so in few images. It waits there for images, and turns back as soon as the tag
// agrees.
#pragma once

#include "outrider/jobs/drive/mission/mission.hpp"

namespace outrider {

/// Begins to look round if the robot stands at a stop, its belief rests on one tag, and another tag can be
/// seen from there; at most a few times at one waypoint. Returns true if it began. O(headings tags
/// obstacles).
bool begin_look_round(DriveMission& mission, double now_s);

/// Returns the next twist of a robot that looks round (`round` is that of the mission). If a second tag
/// agrees, or none was seen in time, the robot turns back to the heading of its stop, and the look ends.
Twist2 step_look_round(DriveMission& mission, LookRound& round, const Pose2& believed, double now_s);

}  // namespace outrider
