// Hub labels of the turns: trees of shortest paths around each hub, pruned where earlier hubs yield the
// distance.
//
// Every turn is a hub; the most important hubs come first. The label of a turn lists the trees that contain
// it. Any two connected turns share a tree whose hub lies on a shortest path between them. A node stores the
// next node towards its hub, so a path is found by following nodes. Thread rule: read-only after
// construction.
// Sources: Abraham, Delling, Goldberg and Werneck, Hierarchical hub labelings for shortest paths (2012);
// Akiba, Iwata and Yoshida, Fast exact shortest-path distance queries on large networks by pruned landmark
// labeling (2013).
#pragma once

#include <optional>

#include "hubs/turns/turn_graph.hpp"

namespace outrider::hub_labelling {

/// A path that is longer by less than this (relative) counts as equally good; this avoids hubs that differ
/// only by rounding.
inline constexpr double equal_within = 1e-13;

struct HubTrees {
  struct HubNode {
    double distance = 0.0;   ///< to the hub, cells
    std::uint32_t next = 0;  ///< node towards the hub; itself there
    std::uint32_t turn = 0;
  };
  struct HubLabel {
    std::uint32_t hub = 0;  ///< its rank
    std::uint32_t node = 0;
    double distance = 0.0;
  };
  std::vector<HubNode> nodes;                 ///< tree after tree, by rank of the hub
  std::vector<std::vector<HubLabel>> labels;  ///< by turn, the nearest hub first
  std::vector<std::uint32_t> hubs;            ///< turn, by rank
};

/// Builds the trees. Returns nothing if there would be more than `most_nodes`, if more than `most_work`
/// labels and edges would be visited, or if `stop` is requested. O(nodes * (edges of a turn + label of a
/// turn)).
std::optional<HubTrees> hub_trees(const TurnGraph& graph, std::vector<std::uint32_t> order,
                                  std::size_t most_nodes, std::uint64_t most_work,
                                  const std::stop_token& stop);

}  // namespace outrider::hub_labelling
