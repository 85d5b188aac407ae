// Trace: a record of a search, in the order of its steps. Planners fill it if Workspace::trace is set;
// viewers and tests read it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace outrider {

/// One expanded state. Costs are in the search's own unit (cells for grids).
struct Expansion {
  std::uint32_t state = 0;
  std::uint32_t parent = 0;  ///< the start is its own parent
  double f = 0.0;            ///< priority at which it left the queue
  double g = 0.0;            ///< cost from the start
  double h = 0.0;            ///< estimated cost to the goal
  friend bool operator==(const Expansion&, const Expansion&) = default;
};

/// A state that was put into the queue for the first time.
struct Opening {
  std::uint32_t state = 0;
  std::uint32_t after = 0;  ///< number of expansions before it
  friend bool operator==(const Opening&, const Opening&) = default;
};

/// The position of a state that is not a vertex of a grid, m.
struct TracePlace {
  double x = 0.0;
  double y = 0.0;
  friend bool operator==(const TracePlace&, const TracePlace&) = default;
};

/// The record of a search.
struct Trace {
  std::size_t most = 1'000'000;       ///< maximum number of recorded expansions; later steps are not recorded
  std::vector<Expansion> expansions;  ///< in order
  std::vector<Opening> openings;      ///< all states that entered the queue, if there is one
  std::vector<TracePlace> places;     ///< position of each state, for searches without a grid

  void record(const Expansion& expansion) {
    if (expansions.size() < most) expansions.push_back(expansion);
  }
  void open(std::uint32_t state) {
    if (expansions.size() < most) openings.push_back({state, static_cast<std::uint32_t>(expansions.size())});
  }
};

}  // namespace outrider
