// Pieces: headings, speeds and points along the legs and arcs of an exact path.
#pragma once

#include <vector>

#include "outrider/motion/pace.hpp"
#include "outrider/path/plan.hpp"

namespace outrider {

/// Headings in which a piece begins and ends, rad.
double heading_in(const PathPiece& piece);
double heading_out(const PathPiece& piece);

/// The piece driven the other way.
PathPiece reversed(const PathPiece& piece);

/// Of a drive along the piece: on an arc no faster than the body can turn.
Limits limits_on(const PathPiece& piece, const Pace& pace);

/// Points along pieces, the first of which begins at the start, and each other where the one before ends: the
/// ends, and on arcs points that turn by at most `step_rad`.
std::vector<Vec2> points_along(Vec2 start, const std::vector<PathPiece>& pieces, double step_rad);

}  // namespace outrider
