// Pursuit maps: the `N C R T M` text format with a grid of costs, a robot and the trajectory of a target.
//
//   N            the size: width,height
//   473,436
//   C            the collision threshold: cells with this cost or more are walls
//   100
//   R            the first cell of the robot: x,y
//   119,45
//   T            the cells of the target, one per line and per second
//   123,247
//   ...
//   M            the costs: one row for each x, with `height` values separated by commas
//   1.0000,25.0, 50,...
//
// Cells count from 1 in the file and from 0 in the problem. All numbers must be integers from 0 to
// 1,000,000,000, in any notation (25, 25.0, 2.5e1). They may be surrounded by blanks, and blank lines may
// follow the last row. The file may be gzip-compressed.
//
// Faults: bad_input with file:line. Sizes are checked against the length of the text before memory is
// allocated. Bounds: sides up to 100,000, 100 million cells, 10 million seconds. O(text).
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
