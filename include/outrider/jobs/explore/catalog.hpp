// The catalogue of exploration strategies; src/jobs/explore/catalog.cpp is the only list.
#pragma once

#include <string_view>
#include <vector>

#include "outrider/jobs/explore/view.hpp"

namespace outrider {

/// A row of the catalogue. choose() returns the index of the next view to visit; `views` must not be empty.
struct ExploreStrategy {
  std::string_view name;
  std::string_view sentence;
  std::string_view paper;
  std::size_t (*choose)(const Views& views, const ExploreState& state, const ExploreOptions& options,
                        Workspace& workspace) = nullptr;
};

/// Returns all strategies in display order. The first is the default.
const std::vector<ExploreStrategy>& explore_strategies();

/// Fault: bad_input with the nearest known name.
Outcome<ExploreStrategy> find_explore_strategy(std::string_view name);

}  // namespace outrider
