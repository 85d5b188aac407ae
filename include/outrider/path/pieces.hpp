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

/// Returns the path of a point that a robot carries `ahead_m` ahead of the one that the pieces are of.
std::vector<PathPiece> carried(const std::vector<PathPiece>& pieces, double ahead_m);

/// Returns the ways of the disks of a robot as chains of points: on arcs they are at most a degree apart, so
/// that the legs stay within 4e-5 of the radius of the arc. A plan without `steering` has one disk, whose way
/// is that of its waypoints.
std::vector<std::vector<Vec2>> disk_ways(const Plan& plan);
/// Returns the largest distance of these legs from the true ways of the disks, m.
double disk_way_error_m(const Plan& plan);

}  // namespace outrider
