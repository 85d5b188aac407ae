// The turns of a mesh as a graph: two turns are joined if a leg of a shortest path may run between them.
//
// Two turns are joined if they see each other, with none between, and the line touches the blocked cells of
// both. The rows are independent of each other: after a change, only the rows of turns that see a changed
// cell would have to be rebuilt. Thread rule: read-only after construction.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <stop_token>
#include <vector>

#include "outrider/core/parallel.hpp"
#include "winding.hpp"

namespace outrider::hub_labelling {

/// Stands for a number that is missing: no turn, no component.
inline constexpr std::uint32_t no_number = std::numeric_limits<std::uint32_t>::max();

struct TurnGraph {
  struct Edge {
    Cell way;  ///< {0, 0}: any edge may follow
    std::uint32_t to = 0;
    double length = 0.0;  ///< cells
  };
  std::vector<Winding> windings;  ///< by turn; none if no edge has a direction
  std::vector<Fan<Edge>> edges;   ///< by turn

  [[nodiscard]] std::size_t turns() const { return edges.size(); }
  [[nodiscard]] std::size_t degree(std::uint32_t turn) const {
    return edges[turn].level.size() + edges[turn].upright.size();
  }
  /// Calls visit() for each edge by which a taut path that came along `came` may leave a turn; {0, 0} means
  /// from nowhere, or along an edge without a direction.
  template <class Visit>
  void onward(std::uint32_t turn, Cell came, Visit visit) const {
    if (came != Cell{}) return edges[turn].onward(windings[turn], came, visit);
    for (const Edge& edge : edges[turn].level) visit(edge);
    for (const Edge& edge : edges[turn].upright) visit(edge);
  }
};

/// Returns the length of a leg, cells.
double length_between(Cell a, Cell b);

/// Builds a graph without windings. make_edges() is called in parallel and returns a function that gives the
/// edges of a turn. Returns nothing if there would be more than `most_edges`, or if `stop` is requested.
template <class MakeEdges>
std::optional<TurnGraph> graph_of(std::size_t turns, std::size_t most_edges, const std::stop_token& stop,
                                  MakeEdges make_edges) {
  constexpr std::size_t block = 32,
                        blocks_at_once = 64;  // turns of a task; tasks between two looks at the limit
  TurnGraph graph{{}, std::vector<Fan<TurnGraph::Edge>>(turns)};
  std::size_t edges = 0;
  for (std::size_t low = 0; low < turns; low += block * blocks_at_once) {
    const std::size_t high = std::min(turns, low + block * blocks_at_once);
    parallel_for((high - low + block - 1) / block, [&](std::size_t k) {
      auto edges_of = make_edges();
      for (std::size_t turn = low + k * block; turn < std::min(high, low + (k + 1) * block); ++turn)
        graph.edges[turn] = edges_of(static_cast<std::uint32_t>(turn));
    });
    for (std::size_t turn = low; turn < high; ++turn) edges += graph.degree(static_cast<std::uint32_t>(turn));
    if (edges > most_edges || stop.stop_requested()) return std::nullopt;
  }
  return graph;
}

/// Builds the graph of the turns of a mesh. Returns nothing if there would be more than `most_edges`, or if
/// `stop` is requested. O(sides seen from all turns), in parallel.
std::optional<TurnGraph> turn_graph(const GridMap& ground, const NavigationMesh& mesh, std::size_t most_edges,
                                    const std::stop_token& stop);

/// Returns the turns ordered by the number of shortest paths through them, most first, estimated from a
/// sample of trees of shortest paths. O(samples * (edges + turns log turns)), in parallel. Ends early if
/// `stop` is requested.
/// Source: Delling, Goldberg, Pajor and Werneck, Robust distance queries on massive networks (2014).
std::vector<std::uint32_t> by_importance(const TurnGraph& graph, const std::stop_token& stop);

}  // namespace outrider::hub_labelling
