// PursuitProblem: a robot on a grid of costs has to stand on the cell of a moving target in the same second.
//
// Each second the robot moves to one of the eight neighbours of its cell or waits, and pays the cost of
// the cell in which it was before. Cells of at least `threshold` are walls to it; between two walls a
// diagonal step is open. The target may be anywhere on the map, also on walls, and is gone after its last
// second. The robot catches it in the first second t > start_s in which both are in the same cell; being
// together at start_s does not count.
//
// Costs are whole numbers of 32 bits and their sums of 64, so every cost and bound is exact.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/world/grid.hpp"

namespace outrider {

using CostGrid = Grid<std::uint32_t>;

struct PursuitProblem {
  std::shared_ptr<const CostGrid> costs;  ///< of one second in each cell
  std::uint32_t threshold = 0;            ///< cells of this cost and above are walls
  Cell start;                             ///< of the robot at start_s
  std::vector<Cell> target;               ///< its cell at second 0, 1, ...
  int start_s = 0;                        ///< the second from which is planned, 0 <= start_s

  [[nodiscard]] bool wall(Cell c) const { return (*costs)[c] >= threshold; }
  /// The last second in which the target can be caught.
  [[nodiscard]] int last_s() const { return static_cast<int>(target.size()) - 1; }
};

/// The problems that are taken: at most so many cells, and so many seconds.
inline constexpr std::size_t most_pursuit_cells = std::size_t{1} << 28U;
inline constexpr std::size_t most_pursuit_seconds = std::size_t{1} << 24U;

/// Whether the problem can be asked. Faults: bad_input without a map, with one of another size than it
/// says, or of too many cells or seconds; with a target off the map; outside_map and start_blocked for
/// the robot.
Status check(const PursuitProblem& problem);

}  // namespace outrider
