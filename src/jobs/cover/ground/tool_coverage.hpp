// The area that the tool of a robot, its disk or a bar, covers on pieces of a track and on a drive.
#pragma once

#include <stop_token>

#include "outrider/jobs/cover/ground/problem.hpp"
#include "outrider/sim/bodies/piece_body.hpp"

namespace outrider::cover {

/// Returns the poses of a robot that drives the pieces exactly and turns in place between them; on arcs one
/// every 2 degrees. Headings are not wrapped.
std::vector<Pose2> poses_along(const Pose2& start, const std::vector<PathPiece>& pieces);

/// Adds a pose of a drive, with a heading that differs from that before by what the robot turned: less than
/// half a turn between two samples.
void add_pose(std::vector<Pose2>& poses, Pose2 next);

/// Returns what the tool covers of the area on the pieces. With `surely`: for every allowed tracking error.
Coverage coverage_along(const Pose2& start, const std::vector<PathPiece>& pieces, const CoverProblem& problem,
                        const Region& area, bool surely, const std::stop_token& stop = {});

/// Returns what the tool covered of the area on a drive.
Coverage coverage_of_drive(const PieceDrive& drive, const CoverProblem& problem, const Region& area,
                           const std::stop_token& stop = {});

/// Returns the part of what the bar passes over on those poses that is outside of the area, by more than
/// rounding. It contains every such place, unless a stop was requested.
Region outside_of(const std::vector<Pose2>& poses, const Bar& bar, const Region& area,
                  const std::stop_token& stop = {});

}  // namespace outrider::cover
