#include "hub_trees.hpp"

#include <algorithm>
#include <limits>
#include <queue>

#include "outrider/core/parallel.hpp"

namespace outrider::hub_labelling {
namespace {

constexpr double far = std::numeric_limits<double>::infinity();

class Growth {
 public:
  Growth(const TurnGraph& graph, HubTrees& trees)
      : graph_(graph), trees_(trees), to_hub_(graph.turns(), far), reached_(graph.turns()) {}

  void grow(std::uint32_t rank) {
    const std::uint32_t hub = trees_.hubs[rank];
    for (const HubTrees::HubLabel& label : trees_.labels[hub]) to_hub_[label.hub] = label.distance;
    reach(hub, 0.0, static_cast<std::uint32_t>(trees_.nodes.size()), {});
    while (!open_.empty()) {
      const auto [distance, turn] = open_.top();
      open_.pop();
      if (reached_[turn].distance < distance || known(turn, distance)) continue;
      reached_[turn].distance = -1.0;  // settled
      add(rank, turn, distance);
    }
    for (const HubTrees::HubLabel& label : trees_.labels[hub]) to_hub_[label.hub] = far;
    for (const std::uint32_t turn : touched_) reached_[turn] = {};
    touched_.clear();
  }
  /// Returns the number of labels and edges visited so far.
  [[nodiscard]] std::uint64_t work() const { return work_; }

 private:
  struct Reached {
    double distance = far;
    std::uint32_t from = 0;  ///< node
    Cell came;
  };

  void reach(std::uint32_t turn, double distance, std::uint32_t from, Cell came) {
    if (!(distance < reached_[turn].distance)) return;
    if (reached_[turn].distance == far) touched_.push_back(turn);
    reached_[turn] = {distance, from, came};
    open_.emplace(distance, turn);
  }

  /// Returns true if an earlier hub yields that distance.
  [[nodiscard]] bool known(std::uint32_t turn, double distance) {
    const double enough = distance * (1.0 + equal_within);
    for (const HubTrees::HubLabel& label : trees_.labels[turn]) {
      ++work_;
      if (to_hub_[label.hub] + label.distance <= enough) return true;
    }
    return false;
  }

  void add(std::uint32_t rank, std::uint32_t turn, double distance) {
    const auto node = static_cast<std::uint32_t>(trees_.nodes.size());
    trees_.nodes.push_back({distance, reached_[turn].from, turn});
    trees_.labels[turn].push_back({rank, node, distance});
    graph_.onward(turn, reached_[turn].came, [&](const TurnGraph::Edge& edge) {
      ++work_;
      reach(edge.to, distance + edge.length, node, edge.way);
    });
  }

  using HubEntry = std::pair<double, std::uint32_t>;
  const TurnGraph& graph_;
  HubTrees& trees_;
  std::vector<double> to_hub_;  ///< by rank, from the hub that grows
  std::vector<Reached> reached_;
  std::vector<std::uint32_t> touched_;
  std::uint64_t work_ = 0;
  std::priority_queue<HubEntry, std::vector<HubEntry>, std::greater<>> open_;
};

}  // namespace

std::optional<HubTrees> hub_trees(const TurnGraph& graph, std::vector<std::uint32_t> order,
                                  std::size_t most_nodes, std::uint64_t most_work,
                                  const std::stop_token& stop) {
  HubTrees trees;
  trees.hubs = std::move(order);
  trees.labels.resize(graph.turns());
  Growth growth(graph, trees);
  for (std::uint32_t rank = 0; rank < trees.hubs.size(); ++rank) {
    growth.grow(rank);
    if (trees.nodes.size() > most_nodes || growth.work() > most_work || stop.stop_requested())
      return std::nullopt;
  }
  parallel_for(trees.labels.size(), [&](std::size_t turn) {
    std::sort(trees.labels[turn].begin(), trees.labels[turn].end(),
              [](const HubTrees::HubLabel& a, const HubTrees::HubLabel& b) {
                return a.distance != b.distance ? a.distance < b.distance : a.hub < b.hub;
              });
  });
  return trees;
}

}  // namespace outrider::hub_labelling
