#include "lemon_search.hpp"

#include <lemon/dijkstra.h>
#include <lemon/static_graph.h>

#include <limits>

namespace outrider::bench {

using lemon::StaticDigraph;

struct LemonSearch::Graph {
  StaticDigraph arcs;
  StaticDigraph::ArcMap<double> lengths{arcs};
};

LemonSearch::LemonSearch(const MoveGraph& graph) : graph_(std::make_unique<Graph>()) {
  graph_->arcs.build(graph.side * graph.side, graph.arcs.begin(), graph.arcs.end());
  for (std::size_t a = 0; a < graph.arcs.size(); ++a) {
    graph_->lengths[StaticDigraph::arc(static_cast<int>(a))] = graph.lengths[a];
  }
}

LemonSearch::~LemonSearch() = default;

double LemonSearch::dijkstra(int start, int goal) {
  lemon::Dijkstra<StaticDigraph, StaticDigraph::ArcMap<double>> search(graph_->arcs, graph_->lengths);
  const auto there = StaticDigraph::node(goal);
  const bool found = search.run(StaticDigraph::node(start), there);
  return found ? search.dist(there) : std::numeric_limits<double>::infinity();
}

}  // namespace outrider::bench
