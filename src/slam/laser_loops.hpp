// Places that come again: recognised, held against chance, and tied together.
//
// The last scans together, as they stand to each other, are searched for among the scans of an earlier visit
// that may be here, given how uncertain their place is from here. What is found counts when most points lie
// on a surface, no other place does nearly as well, and the ties already there can give way to it.
#pragma once

#include <optional>
#include <utility>

#include "key_graph.hpp"
#include "surface_map.hpp"

namespace outrider {

/// Where the surface stands by a map, if that is beyond chance: most points lie on a surface, and no other
/// place in the window does nearly as well.
std::optional<Fit> recognised(const SurfaceMap& map, const Surface& surface, const MatchWindow& window);

struct LoopSearch {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> closed;  ///< scans tied: the earlier, the later
  double tried_at_m = 0.0;                                      ///< way driven at the last search

  /// Ties the last scan to earlier visits and relaxes the graph; true when it did. What lies farther from
  /// where it is believed to be than `reach_sd` standard deviations is a look-alike.
  bool close(KeyGraph& graph, double reach_sd);
};

}  // namespace outrider
