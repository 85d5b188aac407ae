// Building routes: adding goals to a partial route until none is left out.
#pragma once

#include <optional>
#include <stop_token>
#include <vector>

#include "local_search/route.hpp"

namespace outrider::tour {

/// Inserts the goals of `missing`, as listed, each at its best place; `sharing` as in best_insertion().
void insert_all(const Instance& instance, Route& route, const std::vector<std::uint32_t>& missing,
                double sharing);

/// Returns the best of several routes built from nothing: nearest next, cheapest insertion, and cheapest
/// insertion that favours stops by the number of goals they cover, as greedy set cover does. Returns nothing
/// after a stop request.
std::optional<Route> construct(const Instance& instance, const std::stop_token& stop);

}  // namespace outrider::tour
