// The catalogue of exploration strategies; src/jobs/explore/choose/catalog.cpp is the only list.
#pragma once

#include <string_view>
#include <vector>

#include "outrider/jobs/explore/choose/view.hpp"

namespace outrider {

/// A row of the catalogue. values() returns the value of each view, of which the best is chosen, of equal
/// ones the first; NaN for a view that another one counts for. `views` must not be empty.
struct ExploreStrategy {
  std::string_view name;
  std::string_view sentence;
  std::string_view paper;
  std::string_view value_of;  ///< what the values are, with their unit
  /// The guarantee in words; mission.hpp has the reasons to stop.
  std::string_view guarantee =
      "goes on until no frontier that it can reach and see hides enough unknown area; no bound of its time";
  bool most_is_best = false;  ///< the largest value is the best, not the least
  std::vector<double> (*values)(const Views& views, const ExploreState& state, const ExploreOptions& options,
                                Workspace& workspace) = nullptr;
};

/// Returns all strategies in display order. The first is the default.
const std::vector<ExploreStrategy>& explore_strategies();

/// Fault: bad_input with the nearest known name.
Outcome<ExploreStrategy> find_explore_strategy(std::string_view name);

}  // namespace outrider
