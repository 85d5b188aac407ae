// Relaxation: the pursuit without its clock, a lower bound for every cell and a promising way.
//
// A catch at second t after k <= t steps pays its steps, and t - k waits at the cheapest cell on the way.
// For any price p that is at most the cost of every cell that can be reached, it costs at least
//     sum over its steps of (cost - p)  +  p t,
// which is a shortest path on costs - p, to a target cell that is worth p t. bound(x) is the least of it
// from x on; so whoever is in x at second s having paid g pays in all at least g + bound(x) - p s.
// Lowering p makes steps dearer against time: it is the multiplier of "k <= t" (Handler and Zang, A dual
// algorithm for the constrained shortest path problem, 1980). Prices and bounds are in parts of a cost.
// One Dijkstra flood from the target: since every way out of a cell costs the same, each cell is reached
// but once. O(cells log(largest cost)).
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "field.hpp"
#include "outrider/core/budget.hpp"
#include "radix_queue.hpp"

namespace outrider {

/// Bounds and prices count in so many parts of a cost.
inline constexpr std::int64_t price_parts = 16;

/// A way from the start, a second a step, to where the target is at `second`; the robot waits for the
/// seconds that are left. A relaxed way may have more steps than seconds.
struct TimedWay {
  std::vector<CellIndex> cells;
  int second = 0;
};

class Relaxation {
 public:
  /// `catches`: the seconds in which a catch is possible, in order; at least one. No cell of `reached`
  /// costs less than the price.
  Relaxation(const PursuitField& field, const CellSet& reached, std::span<const int> catches,
             std::int64_t price);

  /// Floods on. False: the budget ended first.
  bool run(BudgetMeter& meter);

  [[nodiscard]] std::int64_t price() const { return price_; }
  [[nodiscard]] bool reached(CellIndex i) const { return bound_[i] != unreachable; }
  /// Least total, in parts, for a robot that is in cell i at that second having paid nothing; may be
  /// negative. The cell is reached.
  [[nodiscard]] std::int64_t bound(CellIndex i, int second) const {
    return static_cast<std::int64_t>(bound_[i]) - price_ * (std::int64_t{second} - zero_s_);
  }
  /// The way from the start that has the least relaxed cost.
  [[nodiscard]] TimedWay way() const;

 private:
  struct Source {
    CellIndex cell;
    int second;
  };
  [[nodiscard]] std::uint64_t worth(int second) const {
    return static_cast<std::uint64_t>(price_ * (std::int64_t{second} - zero_s_));
  }
  [[nodiscard]] const Source* source_at(CellIndex i) const;

  const PursuitField* field_;
  std::int64_t price_;
  std::int64_t zero_s_;               // the second that is worth nothing: all are worth at least that
  std::vector<Source> sources_;       // the best second of each cell, by cell
  CellSet open_;                      // reached by the robot, and not yet from the target
  std::vector<std::uint64_t> bound_;  // of being there at second zero_s_
  std::vector<std::uint8_t> step_;    // 1 + which step to take; 0: wait for the target here
  RadixQueue<Ties::oldest_first> queue_;
};

using Relaxations = std::span<const std::unique_ptr<Relaxation>>;

/// The least total, in parts, that any of them allows a robot that is in that cell at that second having
/// paid `cost`; unreachable where no catch is.
std::uint64_t least_total(Relaxations relaxations, CellIndex cell, int second, std::uint64_t cost);

}  // namespace outrider
