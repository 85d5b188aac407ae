// compare_strategies(): exploration strategies on many maps with a perfect pose, in groups, over a proven
// bound.
//
// Each strategy explores each map (explore_maps.hpp) from the same drawn starts (explore_grid.hpp). The time
// of a run is divided by the lower bound for its start (explore_bound.hpp), and by the time of `nearest`
// from the same start. Intervals hold 95 % of 1000 bootstrap samples, which draw the runs of each map anew
// and keep the maps.
#pragma once

#include "suites.hpp"

namespace outrider::bench {

/// The request with `grids`; `maps` of it are names or groups.
Outcome<BenchResult> compare_strategies(const ExploreRequest& request,
                                        const std::vector<std::string>& strategies,
                                        const BenchObserver& observer);

}  // namespace outrider::bench
