// Headland: laps along the borders of a field whose curvature a robot with a turning radius can drive.
//
// The border of the standing room, made smaller by a lap's depth, has corners that no such robot can follow.
// It is opened by the disk of the turning radius R: the border of the room that is R smaller (PolygonGround,
// exact) is moved back outwards by R. Inner corners of the field become arcs of radius R; every point of the
// curve is within the room, since it is R away from a point that has R of room. About outer corners (of
// obstacles) the curve is an arc whose radius is the depth of the lap; where that is less than R the lap is
// cut there, and its straight ends go on beside the corner, as far as the disk has to go to cover what is
// around it.
//
// With reverse, the robot drives from each rounded corner straight on into the corner, backs out, takes the
// arc, backs into the corner along the other side, and goes on: so it covers what a robot does that turns in
// place.
#pragma once

#include "ground/free_room.hpp"
#include "outrider/jobs/cover/strokes/plan.hpp"
#include "strokes/field_work.hpp"

namespace outrider::cover {

/// A part of the track that is driven as a whole, from one end or the other.
struct Stroke {
  std::vector<PathPiece> pieces;  ///< smooth, apart from the changes of direction
  PieceRole role = PieceRole::lap;
  bool closed = false;  ///< ends where it begins, in the same heading
};

/// Returns the strokes of the lap of that number, 0 along the border; none where no lap is left.
Outcome<std::vector<Stroke>> headland_lap(const CoverProblem& problem, const CoverField& field, int number,
                                          double arc_m, const FreeRoom& room);

}  // namespace outrider::cover
