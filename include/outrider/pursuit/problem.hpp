// PursuitProblem: a robot on a cost grid must reach the cell of a moving target in the same second.
//
// Each second the robot moves to one of the eight neighbours of its cell or waits, and pays the cost of the
// cell that it occupied before. Cells with a cost of at least `threshold` are walls for the robot; a diagonal
// step between two walls is allowed. The target may be anywhere on the map, also on walls, and disappears
// after its last second. The robot catches it in the first second t > start_s in which both are in the same
// cell; being in the same cell at start_s does not count.
//
// Costs are integers of 32 bits and their sums integers of 64 bits, so every cost and bound is exact.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/world/grid.hpp"

namespace outrider {

/// The cost of one second in each cell.
using CostGrid = Grid<std::uint32_t>;

/// The input of a pursuit planner.
struct PursuitProblem {
  std::shared_ptr<const CostGrid> costs;  ///< cost of one second in each cell
  std::uint32_t threshold = 0;            ///< cells of this cost and above are walls
  Cell start;                             ///< cell of the robot at start_s
  std::vector<Cell> target;               ///< cell of the target at second 0, 1, ...
  int start_s = 0;                        ///< the second in which the plan begins, at least 0

  /// Returns true if the cell is a wall for the robot.
  [[nodiscard]] bool wall(Cell c) const { return (*costs)[c] >= threshold; }
  /// Returns the last second in which the target can be caught.
  [[nodiscard]] int last_s() const { return static_cast<int>(target.size()) - 1; }
};

/// Returns a cell as the files and all messages of a pursuit write it: the first is (1, 1).
std::string cell_text(Cell cell);

/// Largest numbers of cells and seconds of a problem.
inline constexpr std::size_t most_pursuit_cells = std::size_t{1} << 28U;
inline constexpr std::size_t most_pursuit_seconds = std::size_t{1} << 24U;

/// Checks that the problem is valid. Faults: bad_input for a missing map, a map of wrong size, too many cells
/// or seconds, or a target outside the map; outside_map and start_blocked for the robot.
Status check(const PursuitProblem& problem);

}  // namespace outrider
