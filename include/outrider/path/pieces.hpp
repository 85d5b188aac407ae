// Pieces: headings, speeds and points along the legs and arcs of an exact path.
#pragma once

#include <vector>

#include "outrider/motion/pace.hpp"
#include "outrider/path/plan.hpp"

namespace outrider {

/// Return the heading of the robot at the beginning and at the end of a piece, rad.
double heading_in(const PathPiece& piece);
double heading_out(const PathPiece& piece);

/// Returns the turn of a robot in place from one heading to another: the shorter one, and to the left where
/// both are as short to a microradian.
double turn_in_place(double from_rad, double to_rad);

/// Returns the piece in the opposite direction; a piece that is driven in reverse stays one.
PathPiece reversed(const PathPiece& piece);

/// Returns the limits of speed and acceleration along the piece. On an arc the turn rate of the robot limits
/// the speed.
Limits limits_on(const PathPiece& piece, const Pace& pace);

/// Returns points along consecutive pieces: the start, the ends of the pieces, and on arcs points at most
/// `step_rad` apart. The first piece must begin at `start`, every other piece at the end of the previous one.
std::vector<Vec2> points_along(Vec2 start, const std::vector<PathPiece>& pieces, double step_rad);

}  // namespace outrider
