// The catalogue of ways to choose the next view; src/explore/catalog.cpp is the only list.
#pragma once

#include <string_view>
#include <vector>

#include "outrider/jobs/explore/view.hpp"

namespace outrider {

/// A row. choose() answers with the index of the view to go to, of at least one.
struct ExploreStrategy {
  std::string_view name;
  std::string_view sentence;
  std::string_view paper;
  std::size_t (*choose)(const Views& views, const ExploreState& state, const ExploreOptions& options,
                        Workspace& workspace) = nullptr;
};

/// All of them, in the order of showing; the first is the default.
const std::vector<ExploreStrategy>& explore_strategies();

/// Fault: bad_input with the nearest known name.
Outcome<ExploreStrategy> find_explore_strategy(std::string_view name);

}  // namespace outrider
