#include "turn_graph.hpp"

#include <cmath>

#include "taut_sight.hpp"

namespace outrider::hub_labelling {
namespace {

Fan<TurnGraph::Edge> edges_of(std::uint32_t turn, TautSight& sight, const NavigationMesh& mesh,
                              const Winding& winding) {
  Fan<TurnGraph::Edge> edges;
  const Cell at = mesh.turns[turn].at;
  for (const std::uint32_t seen : sight.from(at)) {
    const Cell there = mesh.turns[seen].at, way{there.x - at.x, there.y - at.y};
    const Winding::Side side = winding.side(way);
    if (side != Winding::Side::neither) edges.add(side, {way, seen, length_between(at, there)});
  }
  edges.sort(winding);
  return edges;
}

}  // namespace

double length_between(Cell a, Cell b) {
  const double x = a.x - b.x, y = a.y - b.y;
  return std::sqrt(x * x + y * y);
}

std::optional<TurnGraph> turn_graph(const GridMap& ground, const NavigationMesh& mesh, std::size_t most_edges,
                                    const std::stop_token& stop) {
  std::vector<Winding> windings = windings_of(mesh);
  auto graph = graph_of(mesh.turns.size(), most_edges, stop, [&] {
    return [&, sight = TautSight(ground, mesh)](std::uint32_t turn) mutable {
      return edges_of(turn, sight, mesh, windings[turn]);
    };
  });
  if (graph) graph->windings = std::move(windings);
  return graph;
}

}  // namespace outrider::hub_labelling
