// Vias: waypoints that the robot passes by without stopping.
#pragma once

#include "outrider/control/follow_waypoints.hpp"

namespace outrider {

inline constexpr double aimed_rad = 0.03;  ///< bearing error below which rotate_then_go drives

/// Part of a room that is used on purpose; the rest is left for errors.
inline constexpr double used_room = 0.7;

/// Returns how far from a via the robot may cut its corner, m.
double room_at(const Waypoint& via, const FollowOptions& options);

/// Returns the angle by which the way turns at a waypoint to which it comes from a position, rad, positive to
/// the left; 0 at the last one.
double corner_rad(Vec2 from, const std::vector<Waypoint>& waypoints, std::size_t waypoint);

/// Returns true if the position is within the room of the next waypoint, or beyond the plane through it that
/// halves its corner. The plane of a corner of more than 90 degrees is that of one of 90 degrees: one that
/// lies nearly along the leg would be crossed by a robot that is only beside the leg.
bool is_passed(const Follower& follower, const std::vector<Waypoint>& waypoints, Vec2 position,
               const FollowOptions& options);

/// Returns the fastest speed on the way to the next stop: at each via ahead, the change of velocity that its
/// corner takes leads the robot no farther from the legs than its room. O(vias within the way in which the
/// robot stops).
double speed_towards_vias(const Follower& follower, const std::vector<Waypoint>& waypoints, Vec2 position,
                          const FollowOptions& options);

/// Makes the waypoint behind the next one, which is a via, the next one.
void pass_by(Follower& follower, const std::vector<Waypoint>& waypoints);

/// Returns the turn from a heading to that of a waypoint, rad: the shorter way, but about half a turn goes
/// the way in which the headings `from_rad` and the waypoint's are written.
double remaining_turn_rad(double from_rad, const Waypoint& goal, double heading_rad);

}  // namespace outrider
