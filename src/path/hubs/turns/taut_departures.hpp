// The labels of the turns by the legs with which they leave a turn, so that a taut path that arrives there
// meets only those labels that continue it.
//
// Thread rule: read-only after construction.
#pragma once

#include "hubs/any_angle/hub_trees.hpp"

namespace outrider::hub_labelling {

struct TautDepartures {
  /// A label with the leg to the next turn; that of the hub itself is {0, 0}, on both sides.
  struct Departure {
    Cell way;
    HubTrees::HubLabel label;
  };
  std::vector<Winding> windings;     ///< by turn
  std::vector<Fan<Departure>> fans;  ///< by turn

  /// Calls visit() for each label of the turn that continues a taut path which arrives along `came`.
  template <class Visit>
  void onward(std::uint32_t turn, Cell came, Visit visit) const {
    fans[turn].onward(windings[turn], came, [&](const Departure& departure) { visit(departure.label); });
  }
};

/// Sorts the labels into fans. O(labels log labels), in parallel.
TautDepartures taut_departures(const NavigationMesh& mesh, const HubTrees& trees);

}  // namespace outrider::hub_labelling
