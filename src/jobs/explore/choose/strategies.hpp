// The rows of the catalogue of strategies.
#pragma once

#include "outrider/jobs/explore/choose/catalog.hpp"

namespace outrider {

std::vector<double> nearness_values(const Views& views, const ExploreState& state,
                                    const ExploreOptions& options, Workspace& workspace);
std::vector<double> gain_values(const Views& views, const ExploreState& state, const ExploreOptions& options,
                                Workspace& workspace);
std::vector<double> round_values(const Views& views, const ExploreState& state, const ExploreOptions& options,
                                 Workspace& workspace);

/// Returns the previously chosen view, if it still exists: of the same frontier, or else the nearest within
/// 0.5 m.
std::optional<std::size_t> chosen_before(const Views& views, const ExploreChoice& before);
/// Returns the bonus of that view, s.
double bonus_of_before(const ExploreState& state, const ExploreOptions& options);

}  // namespace outrider
