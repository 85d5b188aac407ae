// Descent to a local optimum: a route that no single change of a few kinds makes faster.
#pragma once

#include <stop_token>

#include "local_search/route.hpp"

namespace outrider::tour {

/// Moves the visit, from position `begin` on, to the stop that serves the same goals in the same order
/// for less, if there is one. O(nodes of its rarest goal * its goals).
bool restop(const Instance& instance, Route& route, std::uint32_t begin);

/// Repeats until nothing helps: another stop for a visit, another place and stop for a goal, a visit
/// moved, a run of visits reversed. The cost never rises. Ends early after a stop request.
void polish(const Instance& instance, Route& route, const std::stop_token& stop);

}  // namespace outrider::tour
