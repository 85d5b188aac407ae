// BackwardSweep: dynamic programming from the last second of a pursuit back to its first.
//
// The least cost to go from a cell at second t is 0 where the target is, and otherwise the cost of the cell
// plus the least over the cell and its neighbours at t + 1. When the sweep has come to second t, it knows the
// cheapest end of every path from t on, wherever the robot is: a known path can be improved from t on, and a
// robot that goes on meanwhile loses nothing of what is known. O(sum of the boxes), 32 bytes of a row at
// once.
#pragma once

#include <memory>
#include <optional>

#include "bounds/forward_bound.hpp"
#include "bounds/relaxation.hpp"
#include "outrider/core/budget.hpp"
#include "sweeps/layer.hpp"

namespace outrider {

class BackwardSweep {
 public:
  virtual ~BackwardSweep() = default;
  /// Goes on to an earlier second; one row of one second counts as one expansion. Returns false if the budget
  /// ended first.
  virtual bool advance(BudgetMeter& meter, std::uint64_t best) = 0;
  /// The second that it has come to.
  [[nodiscard]] virtual int second() const = 0;
  /// Returns the least cost to go from a cell of the box of this second; `unreachable` if there is no catch.
  [[nodiscard]] virtual std::uint64_t to_go(CellIndex cell) const = 0;
  /// Returns the cheapest way from such a cell, in which each cell is one second.
  [[nodiscard]] virtual TimedWay way_from(CellIndex cell) const = 0;
  /// Returns the work of one way_from() from that second, in cells.
  [[nodiscard]] virtual std::uint64_t way_work() const = 0;
  /// Returns the number of cells swept so far, over all seconds.
  [[nodiscard]] virtual std::uint64_t work() const = 0;

 protected:
  BackwardSweep() = default;
  BackwardSweep(const BackwardSweep&) = default;
  BackwardSweep& operator=(const BackwardSweep&) = default;
};

/// Returns the map for sweeps that look for catches of less than `best`.
AnySweepMap sweep_map(const PursuitField& field, int earliest_catch, std::uint64_t best, Processor processor);

/// Returns a sweep of the boxes of pursuit_boxes(), which also ends with the last of them. One layer is in
/// memory. Layers are kept from time to time, so that ways can be computed again; memory is 2, 4 or 8 bytes
/// for each cell of a kept layer, about (cells seconds^3)^(1/4) of them in all. Eight seconds are swept at
/// once, row behind row, while the rows are in the fast memory.
std::unique_ptr<BackwardSweep> full_sweep(const AnySweepMap& map, std::vector<CellBox> boxes,
                                          const ForwardBound* bound);

/// Returns a sweep of any boxes, of which all layers are kept. For small boxes.
std::unique_ptr<BackwardSweep> stored_sweep(const AnySweepMap& map, std::vector<CellBox> boxes);

}  // namespace outrider
