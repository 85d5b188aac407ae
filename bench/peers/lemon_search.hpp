// LemonSearch: shortest paths by LEMON, whose headers are C++17; so is what is here and in lemon_search.cpp.
#pragma once

#include <memory>

#include "move_graph.hpp"

namespace outrider::bench {

class LemonSearch {
 public:
  explicit LemonSearch(const MoveGraph& graph);
  ~LemonSearch();
  LemonSearch(const LemonSearch&) = delete;
  LemonSearch& operator=(const LemonSearch&) = delete;

  /// Returns the length; infinite without a path.
  double dijkstra(int start, int goal);

 private:
  struct Graph;
  std::unique_ptr<Graph> graph_;
};

}  // namespace outrider::bench
