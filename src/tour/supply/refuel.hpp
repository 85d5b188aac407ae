// Refuel: the best stations to put into a given order of services.
//
// Labels run along the order, each with its time, water and charge; between two services a label may visit up
// to three depots one after the other. A label is dropped when another one with the same heading and gun is
// no later and has no less. A service that no label can serve is left out.
#pragma once

#include <vector>

#include "local_search/route.hpp"
#include "supply/supplied.hpp"

namespace outrider::tour {

struct Refuelled {
  std::vector<std::uint32_t> choices;  // nodes and, behind all nodes, depots
  std::vector<std::uint32_t> dropped;  // goals
  double time = 0.0;
};

struct RefuelLimits {
  std::size_t labels = 8;  // kept after each service: the soonest ones, and the one with the most charge
  std::size_t chain = 2;   // depots between two services
};

/// Nothing is lost but by the limits. O(nodes x labels x depots^chain).
Refuelled refuel(const Supplied& supplied, const std::vector<std::uint32_t>& nodes,
                 const RefuelLimits& limits);

}  // namespace outrider::tour
