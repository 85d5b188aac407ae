// Pursuit maps: the `N C R T M` text of a grid of costs, a robot and the trajectory of a target.
//
//   N            the size: width,height
//   473,436
//   C            the collision threshold: cells of this cost and above are walls
//   100
//   R            the robot's first cell: x,y
//   119,45
//   T            the target's cells, one a line and a second
//   123,247
//   ...
//   M            the costs: one row for each x, `height` values between commas
//   1.0000,25.0, 50,...
//
// Cells count from 1 in the file and from 0 in the problem. Numbers are whole however they are written
// (25, 25.0, 2.5e1), from 0 to 1,000,000,000; blanks may stand around them, blank lines after the last row.
// The file may be gzip-compressed.
//
// Errors: bad_input with file:line. Sizes are checked against the text before memory is taken. Bounds:
// sides up to 100,000, 100 million cells, 10 million seconds. O(text).
// Source of the format: course material of CMU 16-782, "Catching a moving target".
#pragma once

#include <string>
#include <string_view>

#include "outrider/core/outcome.hpp"
#include "outrider/pursuit/problem.hpp"

namespace outrider {

Outcome<PursuitProblem> load_pursuit_map(const std::string& path);
Outcome<PursuitProblem> pursuit_map_from_text(std::string_view text, const std::string& name);

}  // namespace outrider
