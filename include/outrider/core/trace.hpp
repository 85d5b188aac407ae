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

/// Where a state is that is no vertex of a grid, m.
struct TracePlace {
  double x = 0.0;
  double y = 0.0;
  friend bool operator==(const TracePlace&, const TracePlace&) = default;
};

struct Trace {
  std::size_t most = 1'000'000;  ///< later expansions are not recorded, nor what they open
  std::vector<Expansion> expansions;
  std::vector<Opening> openings;   ///< where there is a queue: all that stood in it
  std::vector<TracePlace> places;  ///< by state, of searches that have no grid

  void record(const Expansion& expansion) {
    if (expansions.size() < most) expansions.push_back(expansion);
  }
  void open(std::uint32_t state) {
    if (expansions.size() < most) openings.push_back({state, static_cast<std::uint32_t>(expansions.size())});
  }
};

}  // namespace outrider
