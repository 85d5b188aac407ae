// The area that a bar passes over between two poses, as polygons inside the true sweep or around it.
//
// Two poses of one heading are joined by a straight motion, whose sweep is exact: the convex hull of both
// rectangles. Others are joined by the rotation that takes one to the other, about one centre; a robot that
// turns in place or drives an arc moves like that. Its sweep is both rectangles and what each edge passes
// over. An edge is split at its point nearest to the centre, so that the distance from the centre grows along
// each part. A part that reaches from the radius p to q passes over all between its two ends of which the
// distance is p to q. There the arcs are replaced: for a sweep inside by the chord of q and the tangents of
// p, for one around by the tangents of q and the chord of p.
#pragma once

#include <vector>

#include "outrider/geometry/pose.hpp"
#include "outrider/jobs/cover/ground/coverage.hpp"

namespace outrider::cover {

inline constexpr double sweep_step_rad = 0.035;  ///< largest turn between two poses that are joined at once

enum class Approximation { inside, around };

/// Returns the corners of the bar, counter-clockwise.
std::vector<Vec2> outline_of(const Bar& bar, const Pose2& pose);

/// Returns what the bar passes over. The headings differ by the angle that it really turns, which is at most
/// `sweep_step_rad`.
Region bar_sweep(const Pose2& from, const Pose2& to, const Bar& bar, Approximation how);

/// Returns the poses with others between them, so that none turns by more than `sweep_step_rad` from the one
/// before.
std::vector<Pose2> with_small_turns(const std::vector<Pose2>& poses);

}  // namespace outrider::cover
