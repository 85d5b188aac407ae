// BoostSearch: shortest paths by Boost.Graph.
#pragma once

#include <algorithm>
#include <boost/graph/astar_search.hpp>
#include <boost/graph/compressed_sparse_row_graph.hpp>
#include <boost/graph/dijkstra_shortest_paths.hpp>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <numbers>
#include <vector>

#include "move_graph.hpp"

namespace outrider::bench {

/// A search ends by an exception when the goal is reached, as the documentation of Boost.Graph shows. Returns
/// the length; infinite without a path.
class BoostSearch {
  using Graph = boost::compressed_sparse_row_graph<boost::directedS, boost::no_property, double,
                                                   boost::no_property, std::uint32_t, std::uint32_t>;
  struct Reached {};
  template <class Visitor>
  struct AtGoal : Visitor {
    explicit AtGoal(int at) : goal(vertex(at)) {}
    template <class Any>
    void examine_vertex(std::uint32_t v, const Any&) const {
      if (v == goal) throw Reached();
    }
    std::uint32_t goal;
  };

  static std::uint32_t vertex(int v) { return static_cast<std::uint32_t>(v); }
  [[nodiscard]] double octile(int a, int b) const {
    const int dx = std::abs(a % side_ - b % side_), dy = std::abs(a / side_ - b / side_);
    return std::max(dx, dy) + (std::numbers::sqrt2 - 1.0) * std::min(dx, dy);
  }
  template <class Visitor>
  auto maps(const Visitor& visitor) {
    const auto index = boost::get(boost::vertex_index, graph_);
    return boost::weight_map(boost::get(boost::edge_bundle, graph_))
        .distance_map(boost::make_iterator_property_map(distance_.begin(), index))
        .predecessor_map(boost::make_iterator_property_map(before_.begin(), index))
        .visitor(visitor);
  }
  template <class Search>
  double until_goal(int goal, const Search& search) {
    try {
      search();
    } catch (const Reached&) {
      return distance_[vertex(goal)];
    }
    return std::numeric_limits<double>::infinity();
  }

 public:
  explicit BoostSearch(const MoveGraph& graph)
      : side_(graph.side),
        graph_(boost::edges_are_sorted, graph.arcs.begin(), graph.arcs.end(), graph.lengths.begin(),
               static_cast<std::uint32_t>(graph.side * graph.side)),
        distance_(boost::num_vertices(graph_)),
        before_(distance_.size()) {}

  double dijkstra(int start, int goal) {
    return until_goal(goal, [&] {
      boost::dijkstra_shortest_paths(graph_, vertex(start), maps(AtGoal<boost::dijkstra_visitor<>>(goal)));
    });
  }
  double a_star(int start, int goal) {
    const auto estimate = [this, goal](std::uint32_t v) { return octile(static_cast<int>(v), goal); };
    return until_goal(goal, [&] {
      boost::astar_search(graph_, vertex(start), estimate, maps(AtGoal<boost::astar_visitor<>>(goal)));
    });
  }

 private:
  int side_;
  Graph graph_;
  std::vector<double> distance_;
  std::vector<std::uint32_t> before_;
};

}  // namespace outrider::bench
