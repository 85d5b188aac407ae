// LabelSearch: A* over paths in space with their durations; this is the part of a pursuit search that proves
// optimality.
//
// A label is a path from the start to a cell: the cost of its steps (g), their number of seconds (t) and the
// cheapest cell on it (m). Labels contain no waiting, because all waiting of a path may be done in its
// cheapest cell: a robot that follows a label can be in the cell at second s >= t for g + (s - t) m. So of
// two labels in a cell, the one with
//     t1 <= t2,  m1 <= m2  and  g1 + (t2 - t1) m1 <= g2
// dominates the other, which is dropped. Labels are expanded in the order of the least total that the
// relaxations permit, and dropped if it is not below the best catch. When the queue is empty, the best catch
// is optimal. If the labels of a cell become too many, the search gives up after a stated amount of work.
// Memory: 40 bytes per label, 4 per cell.
// Sources: label setting for constrained shortest paths, Desrochers and Soumis (1988); A* on labels,
// Hernandez et al., Simple and efficient bi-objective search algorithms via fast dominance checks (2023).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "bounds/relaxation.hpp"
#include "field.hpp"
#include "outrider/core/budget.hpp"
#include "radix_queue.hpp"

namespace outrider {

class LabelSearch {
 public:
  /// `relaxations` must have run and must outlive the search; catches that cost `best` or more, from the
  /// start on, are ignored. One unit of work is one comparison of labels; expanding a label counts as eight.
  LabelSearch(const PursuitField& field, Relaxations relaxations, std::uint64_t best,
              std::uint64_t most_work);

  /// Continues the search to a catch cheaper than the best. Returns nothing if the queue is exhausted, the
  /// search gave up, or the budget ended.
  std::optional<TimedWay> next_better(BudgetMeter& meter);

  [[nodiscard]] bool exhausted() const { return queue_.empty(); }
  [[nodiscard]] bool gave_up() const {
    return !queue_.empty() && (work_ >= most_work_ || labels_.size() >= most_labels);
  }
  /// Returns a lower bound of the cost of all catches, except those already returned.
  [[nodiscard]] std::uint64_t lower_bound();
  [[nodiscard]] std::uint64_t labels() const { return labels_.size(); }

 private:
  static constexpr std::uint64_t work_to_take_up = 8;
  static constexpr std::size_t most_labels = std::size_t{1} << 31U;
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  struct PursuitLabel {
    std::uint64_t g;
    std::uint32_t t;
    std::uint32_t m;
    CellIndex cell;
    std::uint32_t parent;
    std::uint32_t next;  // label in the same cell that is not dominated
    bool dropped;
  };

  void add(const PursuitLabel& label, std::uint64_t at_least);
  bool dominated(const PursuitLabel& label);
  [[nodiscard]] TimedWay way_of(std::uint32_t label, int second) const;

  const PursuitField* field_;
  Relaxations relaxations_;
  std::uint64_t best_;
  std::uint64_t most_work_;
  std::uint64_t work_ = 0;
  std::vector<PursuitLabel> labels_;
  std::vector<std::uint32_t> first_;  // first label of each cell
  RadixQueue<Ties::newest_first> queue_;
  std::optional<TimedWay> better_;
};

}  // namespace outrider
