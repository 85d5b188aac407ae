#include "research/path/sampling_tree.hpp"

#include <ompl/base/PlannerData.h>

#include <algorithm>
#include <limits>
#include <set>

namespace outrider {
namespace {

namespace ob = ompl::base;

struct TreeNode {
  Vec2 place;
  std::vector<unsigned> next{};
  unsigned parent = 0;
  double g = std::numeric_limits<double>::infinity();
};

std::vector<TreeNode> nodes_of(const ob::PlannerData& data) {
  std::vector<TreeNode> nodes;
  for (unsigned i = 0; i < data.numVertices(); ++i) nodes.push_back({point_of(data.getVertex(i).getState())});
  for (unsigned i = 0; i < data.numVertices(); ++i) {
    std::vector<unsigned> ends;
    data.getEdges(i, ends);
    for (const unsigned end : ends) {
      nodes[i].next.push_back(end);
      nodes[end].next.push_back(i);
    }
  }
  return nodes;
}

/// Runs Dijkstra's algorithm from the nodes at the start.
void find_ways(std::vector<TreeNode>& nodes, Vec2 start) {
  std::set<std::pair<double, unsigned>> open;
  for (unsigned i = 0; i < nodes.size(); ++i) {
    if (!(nodes[i].place == start)) continue;
    nodes[i].g = 0.0;
    nodes[i].parent = i;
    open.insert({0.0, i});
  }
  while (!open.empty()) {
    const auto [g, i] = *open.begin();
    open.erase(open.begin());
    for (const unsigned k : nodes[i].next) {
      const double length = g + distance(nodes[i].place, nodes[k].place);
      if (!(length < nodes[k].g)) continue;
      open.erase({nodes[k].g, k});
      nodes[k].g = length;
      nodes[k].parent = i;
      open.insert({length, k});
    }
  }
}

}  // namespace

void trace_tree(const ob::Planner& planner, const Problem& problem, const Met& met, Trace& trace) {
  ob::PlannerData data(planner.getSpaceInformation());
  planner.getPlannerData(data);
  std::vector<TreeNode> nodes = nodes_of(data);
  find_ways(nodes, problem.start);

  const auto turn = [&](unsigned i) {
    if (nodes[i].parent == i) return std::size_t{0};
    const auto found = met.order.find({nodes[i].place.x, nodes[i].place.y});
    return found == met.order.end() ? met.order.size() + 1 : found->second + 1;
  };
  std::vector<std::pair<std::size_t, unsigned>> joined;
  for (unsigned i = 0; i < nodes.size(); ++i) {
    if (nodes[i].g < std::numeric_limits<double>::infinity()) joined.emplace_back(turn(i), i);
  }
  std::sort(joined.begin(), joined.end());
  std::vector<std::uint32_t> number(nodes.size());
  for (std::size_t i = 0; i < joined.size(); ++i) number[joined[i].second] = static_cast<std::uint32_t>(i);
  for (const auto& [when, i] : joined) {
    const TreeNode& node = nodes[i];
    const double h = distance(node.place, problem.goal);
    trace.record({number[i], number[node.parent], node.g + h, node.g, h});
    trace.places.push_back({node.place.x, node.place.y});
  }
}

}  // namespace outrider
