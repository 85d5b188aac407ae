#include <algorithm>
#include <limits>
#include <queue>

#include "outrider/core/parallel.hpp"
#include "turn_graph.hpp"

namespace outrider::hub_labelling {
namespace {

constexpr std::size_t most_samples = 96, least_samples = 16;
constexpr std::size_t turns_of_samples = std::size_t{1} << 21U;  // of all sampled trees together, about

/// Shortest paths from one turn to all others.
struct Tree {
  std::vector<std::uint32_t> parent;          ///< no_number at the root and where no path leads
  std::vector<std::uint32_t> below;           ///< turns of the subtree, itself counted; 0 once taken out
  std::vector<std::uint32_t> child, sibling;  ///< the first of each, the next of each
};

Tree tree_from(const TurnGraph& graph, std::uint32_t root) {
  const std::size_t count = graph.turns();
  Tree tree{std::vector(count, no_number), std::vector(count, 0U), std::vector(count, no_number),
            std::vector(count, no_number)};
  std::vector<double> distance(count, std::numeric_limits<double>::infinity());
  std::vector<Cell> came(count);
  std::vector<std::uint32_t> settled;
  using HubEntry = std::pair<double, std::uint32_t>;
  std::priority_queue<HubEntry, std::vector<HubEntry>, std::greater<>> open;
  distance[root] = 0.0;
  open.emplace(0.0, root);
  while (!open.empty()) {
    const auto [g, at] = open.top();
    open.pop();
    if (tree.below[at] != 0) continue;
    tree.below[at] = 1;
    settled.push_back(at);
    graph.onward(at, came[at], [&, from = at, so_far = g](const TurnGraph::Edge& edge) {
      if (!(so_far + edge.length < distance[edge.to])) return;
      distance[edge.to] = so_far + edge.length;
      came[edge.to] = edge.way;
      tree.parent[edge.to] = from;
      open.emplace(distance[edge.to], edge.to);
    });
  }
  for (auto at = settled.rbegin(); at != settled.rend(); ++at) {
    const std::uint32_t up = tree.parent[*at];
    if (up == no_number) continue;
    tree.below[up] += tree.below[*at];
    tree.sibling[*at] = tree.child[up];
    tree.child[up] = *at;
  }
  return tree;
}

/// Removes the subtree of a turn, and its paths from the counts of all turns on them.
void take_out(Tree& tree, std::uint32_t turn, std::vector<std::uint64_t>& paths,
              std::vector<std::uint32_t>& stack) {
  const std::uint32_t lost = tree.below[turn];
  if (lost == 0) return;
  for (std::uint32_t up = tree.parent[turn]; up != no_number; up = tree.parent[up]) {
    tree.below[up] -= lost;
    paths[up] -= lost;
  }
  stack.assign(1, turn);
  while (!stack.empty()) {
    const std::uint32_t at = stack.back();
    stack.pop_back();
    paths[at] -= tree.below[at];
    tree.below[at] = 0;
    for (std::uint32_t child = tree.child[at]; child != no_number; child = tree.sibling[child]) {
      if (tree.below[child] != 0) stack.push_back(child);
    }
  }
}

}  // namespace

std::vector<std::uint32_t> by_importance(const TurnGraph& graph, const std::stop_token& stop) {
  const std::size_t count = graph.turns();
  const std::size_t affordable = turns_of_samples / std::max<std::size_t>(1, count);
  const std::size_t trees_count = std::min(count, std::clamp(affordable, least_samples, most_samples));
  std::vector<Tree> trees(trees_count);
  parallel_for(trees_count, [&](std::size_t k) {
    if (!stop.stop_requested())
      trees[k] = tree_from(graph, static_cast<std::uint32_t>((2 * k + 1) * count / (2 * trees_count)));
  });
  std::vector<std::uint32_t> order;
  if (stop.stop_requested()) return order;
  std::vector<std::uint64_t> paths(count, 0);
  for (const Tree& tree : trees) {
    for (std::size_t turn = 0; turn < count; ++turn) paths[turn] += tree.below[turn];
  }
  // Most paths first, then most edges. An entry counted before other turns were removed is counted again.
  using HubEntry = std::tuple<std::uint64_t, std::size_t, std::uint32_t>;
  const auto entry = [&](std::uint32_t turn) { return HubEntry{paths[turn], graph.degree(turn), ~turn}; };
  std::priority_queue<HubEntry> open;
  for (std::uint32_t turn = 0; turn < count; ++turn) open.push(entry(turn));
  std::vector<std::uint32_t> stack;
  while (!open.empty() && !stop.stop_requested()) {
    const auto [most, edges, name] = open.top();
    const std::uint32_t turn = ~name;
    open.pop();
    if (paths[turn] != most) {
      open.push(entry(turn));
      continue;
    }
    order.push_back(turn);
    for (Tree& tree : trees) take_out(tree, turn, paths, stack);
  }
  return order;
}

}  // namespace outrider::hub_labelling
