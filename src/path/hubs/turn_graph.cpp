#include "turn_graph.hpp"

#include <algorithm>
#include <cmath>

#include "outrider/core/parallel.hpp"
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
  constexpr std::size_t block = 32,
                        blocks_at_once = 64;  // turns of a task; tasks between two looks at the limit
  const std::size_t count = mesh.turns.size();
  TurnGraph graph{windings_of(mesh), std::vector<Fan<TurnGraph::Edge>>(count)};
  std::size_t edges = 0;
  for (std::size_t low = 0; low < count; low += block * blocks_at_once) {
    const std::size_t high = std::min(count, low + block * blocks_at_once);
    parallel_for((high - low + block - 1) / block, [&](std::size_t k) {
      TautSight sight(ground, mesh);
      for (std::size_t turn = low + k * block; turn < std::min(high, low + (k + 1) * block); ++turn)
        graph.edges[turn] = edges_of(static_cast<std::uint32_t>(turn), sight, mesh, graph.windings[turn]);
    });
    for (std::size_t turn = low; turn < high; ++turn) edges += graph.degree(static_cast<std::uint32_t>(turn));
    if (edges > most_edges || stop.stop_requested()) return std::nullopt;
  }
  return graph;
}

}  // namespace outrider::hub_labelling
