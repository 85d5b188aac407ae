// Pieces: headings, speeds and points along the legs and arcs of an exact path.
#pragma once

#include <vector>

#include "outrider/geometry/box.hpp"
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

/// Returns the point that far along the piece; 0 is its beginning, 1 its end.
Vec2 point_on(const PathPiece& piece, double part);
/// Returns the part of the piece before its point that is nearest to p.
double nearest_part(const PathPiece& piece, Vec2 p);
/// Returns what lies between two points of the piece.
PathPiece section_of(const PathPiece& piece, double from_part, double to_part);

/// Returns the limits of speed and acceleration along the piece. On an arc the turn rate of the robot limits
/// the speed.
Limits limits_on(const PathPiece& piece, const Pace& pace);

/// Returns points along consecutive pieces: the start, the ends of the pieces, and on arcs points at most
/// `step_rad` apart. The first piece must begin at `start`, every other piece at the end of the previous one.
std::vector<Vec2> points_along(Vec2 start, const std::vector<PathPiece>& pieces, double step_rad);

/// Returns the smallest box around the piece.
Box2 bounds_of(const PathPiece& piece);

/// Returns the path of a point that a robot carries: `at` in its frame, whose origin takes the piece. The
/// robot has that heading at the beginning of the piece.
PathPiece carried(const PathPiece& piece, double heading_rad, Vec2 at);
/// Returns the path of a point that stands, in the frame of that robot.
PathPiece seen_from(const PathPiece& piece, double heading_rad, Vec2 place);

/// Returns convex polygons that together cover what a robot sweeps along the plan, one for each leg and for
/// each degree of an arc. `outline` is as in Problem. They are exact on legs; on arcs their borders are off
/// by hulls_error_m() at most. O(pieces + degrees), times the corners.
std::vector<std::vector<Vec2>> swept_hulls(const Plan& plan, const std::vector<Vec2>& outline);
double hulls_error_m(const Plan& plan, const std::vector<Vec2>& outline);

}  // namespace outrider
