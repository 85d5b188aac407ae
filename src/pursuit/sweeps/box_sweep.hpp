// BoxSweep: dynamic programming from second to second over the boxes of a pursuit, from the start on.
//
// It needs neither a flood nor a bound, and reads no cell outside the boxes. So it is the quickest where the
// boxes hold few cells. The cost paid on leaving a cell at second t is the cell's own cost plus the least
// cost paid on leaving it or a neighbour at t - 1; a catch costs that least. All layers are kept, 4 bytes for
// each cell of a box, and the cheapest path is read from them. O(sum of the boxes), 32 bytes of a row at
// once.
#pragma once

#include <optional>

#include "outrider/core/budget.hpp"
#include "sweeps/layer.hpp"

namespace outrider {

class BoxSweep {
 public:
  /// The problem must outlive the sweep.
  explicit BoxSweep(const PursuitProblem& problem);

  /// Returns the number of cells of all boxes.
  [[nodiscard]] std::uint64_t work() const { return work_; }
  /// Reads the costs. Returns false if a path may cost 2^30 or more: then it must not be run.
  bool prepare();
  /// Continues to the last second; one row of one second counts as one expansion. Returns false if the budget
  /// ended first.
  bool run(BudgetMeter& meter);
  /// Returns the cheapest catch, and of several the earliest; nothing if there is none.
  [[nodiscard]] std::optional<PursuitPlan> plan() const;

 private:
  using Cost = std::int32_t;
  using Costs = std::vector<Cost, AlignedAllocator<Cost>>;

  void sweep_layer();
  void note_catch(int second);
  [[nodiscard]] Cell target(int second) const {
    return problem_->target[static_cast<std::size_t>(problem_->start_s + second)];
  }
  [[nodiscard]] const CellBox& box(int second) const { return boxes_[static_cast<std::size_t>(second)]; }
  [[nodiscard]] std::size_t index(Cell c) const {
    return static_cast<std::size_t>(c.y - window_.low.y + 1) * stride_ +
           static_cast<std::size_t>(c.x - window_.low.x + row_block<Cost>);
  }
  [[nodiscard]] Cost left(Cell c, int second) const;
  /// Returns the cell around `c` that was left most cheaply at that second, and for how much.
  [[nodiscard]] std::pair<Cell, Cost> cheapest_around(Cell c, int second) const;

  const PursuitProblem* problem_;
  std::vector<CellBox> boxes_;  // of each second from the start
  CellBox window_;              // around all boxes
  std::uint64_t work_ = 0;
  std::size_t stride_ = 0;
  Costs costs_;        // of the window, between borders of walls
  Costs left_, next_;  // paid on leaving each cell at second_, and at the next
  std::optional<RowWindow<Cost>> least_;
  std::vector<Cost> kept_;          // left_ of every second so far, box after box, row after row
  std::vector<std::size_t> begin_;  // of the box of each second in kept_
  int second_ = 0;
  std::uint64_t owed_ = 0;  // expansions to pay for the next layer
  Cost best_ = no_catch<Cost>;
  int best_s_ = -1, earliest_s_ = -1;
};

}  // namespace outrider
