// Reach: the least number of seconds in which the robot can be in each cell, layer by layer, and the seconds
// of possible catches.
//
// The flood goes no farther than the seconds in which a catch may still be cheaper than a known one. O(cells
// reached + seconds).
#pragma once

#include <cstdint>
#include <vector>

#include "field.hpp"
#include "outrider/core/budget.hpp"

namespace outrider {

class Reach {
 public:
  explicit Reach(const PursuitField& field);

  /// Continues the flood until the next second in which the target can be caught, or to the end. Returns
  /// false if the budget ended first.
  bool next_catch(BudgetMeter& meter);

  /// The seconds in which the target can be caught, in order.
  std::vector<int> catches;
  bool complete = false;  ///< no second after the last of `catches` allows one

  CellSet cells;               ///< reached cells
  std::uint32_t cheapest = 0;  ///< the least cost among them

  [[nodiscard]] std::uint64_t size() const { return size_; }  ///< cells reached
  /// Returns a path from the start to a reached cell with the least number of steps.
  [[nodiscard]] std::vector<CellIndex> path_to(CellIndex cell) const;

 private:
  bool flood_one(BudgetMeter& meter);

  const PursuitField* field_;
  CellSet open_;                    // free and not reached
  std::vector<std::uint8_t> mark_;  // 1 + steps modulo 255; 0 where not reached
  std::vector<CellIndex> frontier_, next_;
  std::size_t done_ = 0;  // number of expanded cells of the frontier
  std::uint64_t size_ = 1;
  int second_ = 0;  // second of the frontier
};

}  // namespace outrider
