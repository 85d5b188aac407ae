// Hub labels of the turns: trees of shortest paths round each hub, pruned where earlier hubs tell the
// distance.
//
// Every turn is a hub, the most important first. The label of a turn names the trees that it is in; any two
// joined turns share one whose hub lies on a shortest path between them. A node knows the next one towards
// its hub, so that paths are had by following nodes. Thread rule: read only once made. Sources: Abraham,
// Delling, Goldberg and Werneck, Hierarchical hub labelings for shortest paths (2012); Akiba, Iwata and
// Yoshida, Fast exact shortest-path distance queries on large networks by pruned landmark labeling (2013).
#pragma once

#include <optional>

#include "turn_graph.hpp"

namespace outrider::hub_labelling {

/// A way that is longer by less than this, relative, is as good: it spares hubs that differ by rounding
/// alone.
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
  /// The same with the way to the next turn; that of the hub itself, {0, 0}, on both sides.
  struct Departure {
    Cell way;
    HubLabel label;
  };
  std::vector<HubNode> nodes;                 ///< tree after tree, by rank of the hub
  std::vector<std::vector<HubLabel>> labels;  ///< by turn, by rank of the hub
  std::vector<Winding> windings;              ///< by turn
  std::vector<Fan<Departure>> departures;     ///< by turn
  std::vector<std::uint32_t> hubs;            ///< turn, by rank

  /// Forgets what only the making of lists needs.
  void keep_paths_alone() {
    nodes.shrink_to_fit();
    labels = {};
    departures = {};
  }
};

/// Nothing when there would be more than `most_nodes`, or when `stop` asks for it. O(nodes * (edges of a turn
/// + label of a turn)).
std::optional<HubTrees> hub_trees(const NavigationMesh& mesh, const TurnGraph& graph,
                                  std::vector<std::uint32_t> order, std::size_t most_nodes,
                                  const std::stop_token& stop);

}  // namespace outrider::hub_labelling
