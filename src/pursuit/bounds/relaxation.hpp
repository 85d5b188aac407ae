// Relaxation: the pursuit without the time constraint. It yields a lower bound for every cell and a candidate
// path.
//
// A catch at second t after k <= t steps pays for its steps, and for t - k waits at the cheapest cell on the
// path. For any price p that is at most the cost of every reachable cell, it costs at least
//     sum over its steps of (cost - p)  +  p t,
// which is a shortest path with costs reduced by p to a target cell of value p t. bound(x) is the least such
// cost from x on. So a robot in x at second s that has paid g pays in total at least g + bound(x) - p s. A
// lower p makes steps more expensive relative to time: p is the multiplier of "k <= t" (Handler and Zang, A
// dual algorithm for the constrained shortest path problem, 1980). Prices and bounds are in fractions of a
// cost. The computation is one Dijkstra flood from the target. All paths out of a cell cost the same, so each
// cell is reached only once. O(cells log(largest cost)).
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "field.hpp"
#include "outrider/core/budget.hpp"
#include "radix_queue.hpp"

namespace outrider {

/// Number of parts of a cost in which bounds and prices are counted.
inline constexpr std::int64_t price_parts = 16;

/// A path from the start, one step per second, to the cell of the target at `second`; the robot waits during
/// the remaining seconds. A relaxed path may have more steps than seconds.
struct TimedWay {
  std::vector<CellIndex> cells;
  int second = 0;
};

class Relaxation {
 public:
  /// `catches` are the seconds in which a catch is possible, in order; there must be at least one. No cell of
  /// `reached` may cost less than the price.
  Relaxation(const PursuitField& field, const CellSet& reached, std::span<const int> catches,
             std::int64_t price);

  /// Continues the flood. Returns false if the budget ended first.
  bool run(BudgetMeter& meter);

  [[nodiscard]] std::int64_t price() const { return price_; }
  [[nodiscard]] bool reached(CellIndex i) const { return bound_[i] != unreachable; }
  /// Returns the least total, in parts, for a robot that is in cell i at that second and has paid nothing; it
  /// may be negative. The cell must be reached.
  [[nodiscard]] std::int64_t bound(CellIndex i, int second) const {
    return static_cast<std::int64_t>(bound_[i]) - price_ * (std::int64_t{second} - zero_s_);
  }
  /// Returns the next cell of the relaxed path from a reached cell, or the cell itself where it ends.
  [[nodiscard]] CellIndex next(CellIndex i) const {
    return step_[i] == 0 ? i : i + field_->steps()[step_[i] - 1U];
  }
  /// Returns the second of the catch at a cell where a path ends.
  [[nodiscard]] int catch_at(CellIndex i) const { return source_at(i)->second; }
  /// Returns the path from the start with the least relaxed cost.
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
  std::vector<std::uint64_t> bound_;  // bound for being there at second zero_s_
  std::vector<std::uint8_t> step_;    // 1 + which step to take; 0: wait for the target here
  RadixQueue<Ties::oldest_first> queue_;
};

using Relaxations = std::span<const std::unique_ptr<Relaxation>>;

/// Returns the largest of the lower bounds of the relaxations, in parts, for a robot that is in that cell at
/// that second and has paid `cost`; `unreachable` if there is no catch.
std::uint64_t least_total(Relaxations relaxations, CellIndex cell, int second, std::uint64_t cost);

}  // namespace outrider
