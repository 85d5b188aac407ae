// A lower bound on the length of every track that covers all of an area for every allowed tracking error.
//
// Let S be the standing room of the centre, r the radius of the disk and q the sure radius, r minus the
// tracking error. A track that surely covers everything within q of S comes within q of each of these points.
// A point at the distance q from a straight side of S, outside of it, has only one point of S so near, the
// foot of its perpendicular; so the track runs along every straight side of S, on its whole length. The rest
// of the track hangs together with that, and a disk of radius q covers at most 2 q of new area on each metre.
// Hence
//     length >= straight sides of S + (area within q of S but not within q of its straight sides) / (2 q).
// This counts what laps along walls cover twice where walls are less than 2 q apart: no track avoids it. It
// leaves out turns, drives between parts, and that lanes do not fit everywhere, so it need not be reached.
// The planner may leave a fraction `uncovered` of the reach out, and may then fall below by little.
#pragma once

#include <stop_token>

#include "outrider/jobs/cover/ground/problem.hpp"

namespace outrider {

/// Returns the bound, m; 0 for a bar, which covers without driving where it turns in place. O(n) unions for n
/// walls. Ends soon after `stop` is requested; the result is then meaningless.
double least_length_m(const CoverageArea& area, const CoverProblem& problem,
                      const std::stop_token& stop = {});

}  // namespace outrider
