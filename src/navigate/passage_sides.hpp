// The sides of passages: where a robot that goes a way is on the wrong side of a passage.
//
// A passage is where the nearest obstacle and the one opposite to it are at most `passage_m` apart. A robot
// that is farther from the one on the preferred side than a third of that is on the wrong side. The nearest
// obstacles are those of Danielsson, Euclidean distance mapping (Computer Graphics and Image Processing 14,
// 1980). O(cells * cells across a passage).
#pragma once

#include <cstdint>
#include <vector>

#include "outrider/world/grid.hpp"

namespace outrider {

/// Sets bit n of a cell if a robot that goes from there against neighbours[n] is on the wrong side. `side`: 1
/// if the left side is preferred, -1 if the right one is.
void find_wrong_sides(const GridFrame& frame, const std::vector<Vec2>& obstacles, double passage_m, int side,
                      std::vector<std::uint8_t>& wrong);

}  // namespace outrider
