#include "taut_departures.hpp"

#include "outrider/core/parallel.hpp"

namespace outrider::hub_labelling {

TautDepartures taut_departures(const NavigationMesh& mesh, const HubTrees& trees) {
  using Departure = TautDepartures::Departure;
  TautDepartures departures{windings_of(mesh), std::vector<Fan<Departure>>(trees.labels.size())};
  parallel_for(trees.labels.size(), [&](std::size_t turn) {
    const Winding& winding = departures.windings[turn];
    Fan<Departure>& fan = departures.fans[turn];
    const Cell at = mesh.turns[turn].at;
    Departure own;
    for (const HubTrees::HubLabel& label : trees.labels[turn]) {
      const Cell next = mesh.turns[trees.nodes[trees.nodes[label.node].next].turn].at;
      const Cell way{next.x - at.x, next.y - at.y};
      if (way == Cell{}) {
        own = {way, label};
      } else {
        fan.add(winding.side(way), {way, label});
      }
    }
    fan.sort(winding);
    fan.level.insert(fan.level.begin(), own);
    fan.upright.insert(fan.upright.begin(), own);
  });
  return departures;
}

}  // namespace outrider::hub_labelling
