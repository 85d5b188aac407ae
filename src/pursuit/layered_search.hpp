// LayeredSearch: a search second by second over the cells in which the robot may still be on a cheaper path.
//
// This is the sweep of every cell in every second (sweep.hpp), without the states whose cost plus relaxed
// bound is not below the best catch. At worst it takes as long as the plain sweep, on any map. It takes over
// if there are too many labels (label_search.hpp): many different costs and much time to wait. The layer of
// every n-th second is stored, with n about sqrt(3 seconds); a path is found by repeating each such block
// with recorded moves. Memory: 17 bytes per cell, 16 per stored state, 5 per state of one block.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "field.hpp"
#include "outrider/core/budget.hpp"
#include "relaxation.hpp"

namespace outrider {

class LayeredSearch {
 public:
  /// `relaxations` must have run and must outlive the search; catches that cost `best` or more are ignored.
  LayeredSearch(const PursuitField& field, Relaxations relaxations, std::uint64_t best);

  /// Continues the search. The cheapest path, if it is below the best, is returned at the end of the search.
  /// Finding its moves then takes up to as long again, regardless of the budget.
  std::optional<TimedWay> next_better(BudgetMeter& meter);

  [[nodiscard]] bool exhausted() const { return layer_.empty(); }
  /// Returns a lower bound of the cost of all catches, except those already found.
  [[nodiscard]] std::uint64_t lower_bound() const;

 private:
  struct State {
    CellIndex cell;
    std::uint64_t cost;
  };
  using Layer = std::vector<State>;
  struct Moves {
    std::vector<CellIndex> cells;
    std::vector<std::uint8_t> steps;  // source neighbour, in the order of a window of nine
  };

  bool take_up_layer(BudgetMeter& meter);
  void finish_layer(Moves* moves);
  [[nodiscard]] TimedWay way() const;
  /// Returns the moves into each second after that of the stored layer, up to `last`.
  std::vector<Moves> replay(std::size_t kept, int last, const LayeredSearch& recorded);

  const PursuitField* field_;
  Relaxations relaxations_;
  std::uint64_t best_;
  std::uint64_t least_total_ = 0;  // over the present layer, in parts
  int caught_s_ = 0;               // second of the best catch; 0 for none
  int second_ = 0;                 // second of the present layer
  std::size_t done_ = 0;           // number of expanded states of the layer
  Layer layer_;
  std::vector<Layer> kept_;  // layers of second 0, block_s_, 2 block_s_, ...
  int block_s_;
  std::vector<CellIndex> touched_;   // cells of the next layer
  std::vector<std::uint64_t> cost_;  // cost of each cell of the next layer
  std::vector<std::uint8_t> step_;
};

}  // namespace outrider
