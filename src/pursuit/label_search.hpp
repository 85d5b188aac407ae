// LabelSearch: A* over ways through space with their clock, the part of a pursuit that proves.
//
// A label is a way from the start to a cell: what its steps cost (g), how many seconds they take (t) and
// the cheapest cell on it (m). Waiting is left out, for all the waiting of a way may be done in its
// cheapest cell: a robot that has come to a cell by a label can be there at second s >= t for
// g + (s - t) m. So of two labels in a cell, the one with
//     t1 <= t2,  m1 <= m2  and  g1 + (t2 - t1) m1 <= g2
// does whatever the other can for no more, and the other is dropped. Labels are taken up by the
// least total that the relaxations allow, and dropped when that is not below the best catch. When the
// queue is empty the best catch is the cheapest there is. Where the labels of a cell grow many the search
// gives up after a stated amount of work. Memory: 40 bytes a label, 4 a cell.
// Source: label setting for constrained shortest paths, Desrochers and Soumis (1988); A* on labels,
// Hernandez et al., Simple and efficient bi-objective search algorithms via fast dominance checks (2023).
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "field.hpp"
#include "outrider/core/budget.hpp"
#include "radix_queue.hpp"
#include "relaxation.hpp"

namespace outrider {

class LabelSearch {
 public:
  /// `relaxations` have run and outlive the search; catches of `best` and more are of no interest. Work is
  /// counted in labels compared, and eight for each label taken up.
  LabelSearch(const PursuitField& field, Relaxations relaxations, std::uint64_t best,
              std::uint64_t most_work);

  /// Searches on to a catch cheaper than the best. Nothing when the queue is exhausted, when the search
  /// gave up, or when the budget ended.
  std::optional<TimedWay> next_better(BudgetMeter& meter);

  [[nodiscard]] bool exhausted() const { return queue_.empty(); }
  [[nodiscard]] bool gave_up() const {
    return !queue_.empty() && (work_ >= most_work_ || labels_.size() >= most_labels);
  }
  /// No catch costs less, but for those already returned.
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
  std::vector<std::uint32_t> first_;  // of each cell
  RadixQueue<Ties::newest_first> queue_;
  std::optional<TimedWay> better_;
};

}  // namespace outrider
