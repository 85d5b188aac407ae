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

struct Trace {
  std::size_t most = 1'000'000;  ///< later expansions are not recorded
  std::vector<Expansion> expansions;

  void record(const Expansion& expansion) {
    if (expansions.size() < most) expansions.push_back(expansion);
  }
};

}  // namespace outrider
