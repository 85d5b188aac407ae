// TubeSearch: improves a path by sweeps over the cells near it, in each second.
//
// The tube of a radius holds the cells at most so far from where the path is at each second, and then from
// the target. The cheapest path in it replaces the path, and is the axis of the next tube; when it is
// not much cheaper, the radius is doubled. Each tube takes a small part of the time of a sweep of all cells,
// so a good path is known soon. Ends after a stated number of cells.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "sweeps/backward_sweep.hpp"

namespace outrider {

class TubeSearch {
 public:
  /// `boxes` are those of pursuit_boxes(). All must outlive the search.
  TubeSearch(const AnySweepMap& map, const PursuitField& field, std::span<const CellBox> boxes,
             std::uint64_t most_work);

  /// Continues to a way from the start for less than `cost`, which is the cost of `path` from there. `path`
  /// has a cell for each second, and is that of the last way found. Returns nothing if the search is
  /// exhausted or the budget ended.
  std::optional<TimedWay> next_better(BudgetMeter& meter, std::span<const Cell> path, std::uint64_t cost);

  [[nodiscard]] bool exhausted() const { return exhausted_; }

 private:
  bool open(std::span<const Cell> path);

  const AnySweepMap* map_;
  const PursuitField* field_;
  std::span<const CellBox> boxes_;
  std::uint64_t most_work_;
  int radius_;
  bool exhausted_ = false;
  std::unique_ptr<BackwardSweep> sweep_;
};

}  // namespace outrider
