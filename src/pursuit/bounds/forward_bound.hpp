// ForwardBound: a lower bound of the cost from the robot's place to any cell at any second.
//
// The counterpart of Relaxation, from the robot: a path to cell x at second s costs at least
//     sum over its steps of (cost - p)  +  p (seconds),
// for any price p that is at most the cost of every cell that can be reached. One flood gives the least sum
// for every cell. All paths through a cell leave it at the same cost, so each cell is reached only once, from
// the neighbour that is left most cheaply. O(cells log(largest cost)).
#pragma once

#include <cstdint>
#include <vector>

#include "bounds/relaxation.hpp"
#include "field.hpp"
#include "outrider/core/budget.hpp"
#include "radix_queue.hpp"

namespace outrider {

class ForwardBound {
 public:
  /// The robot is in cell `from` at second `from_s`, and has paid `paid`. No cell of `reached` may cost less
  /// than the price, which is in parts of a cost.
  ForwardBound(const PursuitField& field, const CellSet& reached, CellIndex from, int from_s,
               std::uint64_t paid, std::int64_t price);

  /// Continues the flood. Returns false if the budget ended first.
  bool run(BudgetMeter& meter);

  [[nodiscard]] bool reached(CellIndex cell) const { return bound_[cell] != unreachable; }
  /// Returns the number of steps of the way to a reached cell.
  [[nodiscard]] int steps(CellIndex cell) const { return steps_[cell]; }
  /// Returns the cost of these steps.
  [[nodiscard]] std::uint64_t cost(CellIndex cell) const {
    const std::int64_t parts =
        static_cast<std::int64_t>(bound_[cell] - bound_[from_]) + price_ * steps_[cell];
    return static_cast<std::uint64_t>(parts / price_parts);
  }
  /// Returns the cell before a reached one on its way; it must not be the first.
  [[nodiscard]] CellIndex before(CellIndex cell) const { return before_[cell]; }

  /// Returns true if a catch of less than `best` may lead through the cell at that second, for `to_go`
  /// from there on.
  [[nodiscard]] bool allows(CellIndex cell, int second, std::uint64_t to_go, std::uint64_t best) const {
    if (bound_[cell] == unreachable) return false;
    const std::int64_t parts = static_cast<std::int64_t>(bound_[cell] + price_parts * to_go) +
                               price_ * (std::int64_t{second} - from_s_);
    return parts <= price_parts * (static_cast<std::int64_t>(best) - 1);
  }

 private:
  const PursuitField* field_;
  CellIndex from_;
  int from_s_;
  std::int64_t price_;
  CellSet open_;                      // reached by the robot, and not yet by the flood
  std::vector<std::uint64_t> bound_;  // in parts, at second from_s_
  std::vector<int> steps_;
  std::vector<CellIndex> before_;
  RadixQueue<Ties::oldest_first> queue_;  // cells by what is paid on leaving them
};

}  // namespace outrider
