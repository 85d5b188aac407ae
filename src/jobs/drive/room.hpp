// How far the corners of a course may be cut.
#pragma once

#include "outrider/jobs/drive/task.hpp"
#include "outrider/world/collision_map.hpp"

namespace outrider {

/// Sets the room of each waypoint that is no stop: the most by which its corner can be rounded so that the
/// robot keeps 0.9 of the margin (clearance less radius) that the two legs at it have; at most `follow.pass`.
/// O(waypoints obstacles nearby).
void set_rooms(DriveTask& task, const CollisionMap& ground);

}  // namespace outrider
