#include "octile_lists.hpp"

#include "grid/octile.hpp"

namespace outrider::hub_labelling {
namespace {

/// Reaches a subgoal itself, and from other cells the first subgoals on the legs.
class OctileReach {
 public:
  OctileReach(const GridMap& ground, const Subgoals& subgoals, const HubTrees& trees)
      : ground_(ground), subgoals_(subgoals), trees_(trees), reach_(ground, subgoals) {}

  template <class Take>
  std::size_t labels_from(Cell cell, Take take) {
    const auto labels_of = [&](std::uint32_t subgoal) {
      const double leg = octile_distance(cell, subgoals_.cells[subgoal]).value();
      for (const HubTrees::HubLabel& label : trees_.labels[subgoal]) take(leg, label);
    };
    const std::uint32_t own = subgoals_.number[ground_.index(cell)];
    if (own != Subgoals::none) {
      labels_of(own);
      return 1;
    }
    const std::vector<std::uint32_t>& reached = reach_.from(cell);
    for (const std::uint32_t subgoal : reached) labels_of(subgoal);
    return reached.size();
  }

 private:
  const GridMap& ground_;
  const Subgoals& subgoals_;
  const HubTrees& trees_;
  SubgoalReach reach_;
};

/// Returns the exact distances of all nodes to their hubs; nothing if one is too long for an entry.
std::optional<std::vector<Octile>> distances_of(const Subgoals& subgoals, const HubTrees& trees) {
  constexpr std::int32_t most = std::numeric_limits<std::uint16_t>::max();
  std::vector<Octile> distances(trees.nodes.size());
  for (std::size_t node = 0; node < distances.size(); ++node) {  // the next node has been computed before
    const HubTrees::HubNode& at = trees.nodes[node];
    distances[node] = distances[at.next] +
                      octile_distance(subgoals.cells[at.turn], subgoals.cells[trees.nodes[at.next].turn]);
    if (distances[node].straight > most || distances[node].diagonal > most) return std::nullopt;
  }
  return distances;
}

std::vector<OctileNode> nodes_of(const Subgoals& subgoals, const HubTrees& trees) {
  std::vector<OctileNode> nodes;
  nodes.reserve(trees.nodes.size());
  for (const HubTrees::HubNode& node : trees.nodes) {
    const Cell at = subgoals.cells[node.turn];
    nodes.push_back({node.next, static_cast<std::int16_t>(at.x), static_cast<std::int16_t>(at.y)});
  }
  return nodes;
}

}  // namespace

std::optional<OctileLists> octile_lists(const GridMap& ground, const Subgoals& subgoals,
                                        const HubTrees& trees, std::size_t most_bytes,
                                        const std::stop_token& stop) {
  const auto distances = distances_of(subgoals, trees);
  if (!distances) return std::nullopt;
  OctileLists lists{nodes_of(subgoals, trees), {}};
  lists.rows = tile_rows<OctileTileRow>(ground, most_bytes, stop, [&](int low_y) {
    OctileTileRow row;
    const auto add = [&](const std::vector<TileLabel>& labels) {
      row.tiles.push_back(static_cast<std::uint32_t>(row.hubs.size()));
      for (const auto& [hub, node, cells] : labels) {
        const auto [straight, diagonal] = (*distances)[node];
        const OctileNode& at = lists.nodes[node];
        row.hubs.push_back(hub);
        row.cells.push_back(cells);
        row.paths.push_back(
            {node, static_cast<std::uint16_t>(straight), static_cast<std::uint16_t>(diagonal), at.x, at.y});
      }
    };
    TileLabels<OctileReach> labels(trees, OctileReach(ground, subgoals, trees));
    each_tile(low_y, ground, labels, add);
    add({});  // the end of the last tile
    row.work = labels.work();
    row.tiles.shrink_to_fit();
    row.hubs.shrink_to_fit();
    row.cells.shrink_to_fit();
    row.paths.shrink_to_fit();
    return row;
  });
  return lists;
}

}  // namespace outrider::hub_labelling
