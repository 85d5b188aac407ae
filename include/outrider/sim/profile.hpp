// The side view of a shot: the section of the world in the vertical plane of the flight.
#pragma once

#include <vector>

#include "outrider/ballistics/shot.hpp"
#include "outrider/log/messages/gun_messages.hpp"

namespace outrider {

/// Returns the cut solids as convex polygons with coordinates (distance from the muzzle along the flight,
/// height). They extend to 0.6 m beyond the ends of the flight and 0.3 m below its lowest point. The target
/// is the last one.
std::vector<outrider_msgs::ProfilePiece> profile_of(const Flight& flight, const Impact& impact,
                                                    const FlightSpace& space, const Target& target);

/// Returns the ball's positions at 33 evenly spaced times; none if the flight is a parabola.
std::vector<geometry_msgs::Point> path_of(const Flight& flight, const Impact& impact);

}  // namespace outrider
