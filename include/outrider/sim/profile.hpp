// The side view of a shot: what the vertical plane of a flight cuts.
#pragma once

#include <optional>
#include <vector>

#include "outrider/ballistics/shot.hpp"
#include "outrider/report/report.hpp"

namespace outrider {

/// Convex polygons in (distance from the muzzle along the flight, height), within 0.6 m of the flight's
/// ends and down to 0.3 m below its lowest point; the target comes last.
std::vector<ProfilePiece> profile_of(const Flight& flight, const Impact& impact, const FlightSpace& space,
                                     const Target& target);

/// Where the ball is at 33 equal times of the flight; nothing for a parabola.
std::optional<std::vector<Vec3>> path_of(const Flight& flight, const Impact& impact);

}  // namespace outrider
