// Trace: what a search did, in the order in which it did it. Planners fill it when the caller hangs
// one into their workspace; viewers and tests read it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace outrider {

/// One expanded state. Costs are in the search's own unit (cells for grids).
struct Expansion {
  std::uint32_t state = 0;
  std::uint32_t parent = 0;  ///< the state itself at the start
  double f = 0.0;            ///< priority at which it left the queue
  double g = 0.0;            ///< cost from the start
  double h = 0.0;            ///< estimated cost to the goal
  friend bool operator==(const Expansion&, const Expansion&) = default;
};

/// A state that was put into the queue for the first time.
struct Opening {
  std::uint32_t state = 0;
  std::uint32_t after = 0;  ///< so many expansions
  friend bool operator==(const Opening&, const Opening&) = default;
};

struct Trace {
  std::size_t most = 1'000'000;  ///< later expansions are not recorded, nor what they open
  std::vector<Expansion> expansions;
  std::vector<Opening> openings;  ///< by best_first() (search); other searches tell of expansions only

  void record(const Expansion& expansion) {
    if (expansions.size() < most) expansions.push_back(expansion);
  }
  void open(std::uint32_t state) {
    if (expansions.size() < most) openings.push_back({state, static_cast<std::uint32_t>(expansions.size())});
  }
};

}  // namespace outrider
