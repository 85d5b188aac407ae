// Presence: where a robot may be during each part of a drive, and whether two robots keep apart. It is
// conservative, for robots that turn in place and drive straight (straights.hpp). Level ground. Units: m, s,
// rad.
#pragma once

#include <vector>

#include "outrider/geometry/convex.hpp"
#include "outrider/motion/robot_model.hpp"

namespace outrider {

/// Says where a robot is during some time: somewhere on a segment.
struct Presence {
  double begin_s = 0.0;
  double end_s = 0.0;
  Segment within;
};

/// Returns that a robot stands at a place for ever.
Presence standing(Vec2 place, double begin_s);

/// Returns where a robot is during a drive from rest, in pieces of at most 0.25 s, and that it stands at the
/// end for ever after. If the drive may end up to `arrival_error_m` beside the last waypoint, the pieces of
/// the last leg are longer in space and time, such that at all times the robot is that near to one of those
/// that last then. Pieces begin and end in the order of time.
std::vector<Presence> presences(const RobotModel& robot, double heading_rad,
                                const std::vector<Vec2>& waypoints, double begin_s, double arrival_error_m);

/// Returns false if the two may come nearer than `gap_m` at some time. Both lists are in the order of time.
/// It is conservative: at one time, any two points of the segments count.
bool keep_apart(const std::vector<Presence>& one, const std::vector<Presence>& other, double gap_m);

}  // namespace outrider
