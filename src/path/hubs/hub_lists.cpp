#include "hub_lists.hpp"

#include <algorithm>

#include "taut_sight.hpp"

namespace outrider::hub_labelling {
namespace {

/// Reaches the turns that a corner sees.
class TautReach {
 public:
  TautReach(const GridMap& ground, const NavigationMesh& mesh, const TautDepartures& departures)
      : mesh_(mesh), departures_(departures), sight_(ground, mesh) {}

  template <class Take>
  std::size_t labels_from(Cell corner, Take take) {
    const std::vector<std::uint32_t>& seen = sight_.from(corner);
    for (const std::uint32_t turn : seen) {
      const Cell at = mesh_.turns[turn].at;
      const double leg = length_between(corner, at);
      departures_.onward(turn, {at.x - corner.x, at.y - corner.y},
                         [&](const HubTrees::HubLabel& label) { take(leg, label); });
    }
    return seen.size();
  }

 private:
  const NavigationMesh& mesh_;
  const TautDepartures& departures_;
  TautSight sight_;
};

/// Adds the list of a tile to a row. `used` is memory for the turns of the list.
void add_tile(const std::vector<TileLabel>& labels, const NavigationMesh& mesh, const HubTrees& trees,
              std::vector<std::uint32_t>& used, TileRow& row) {
  row.tiles.push_back(
      {static_cast<std::uint32_t>(row.entries.size()), static_cast<std::uint32_t>(row.turns.size())});
  used.clear();
  for (const TileLabel& label : labels) used.push_back(trees.nodes[label.node].turn);
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  for (const std::uint32_t turn : used) row.turns.push_back(mesh.turns[turn].at);
  for (const auto& [hub, node, corners] : labels) {
    const auto [distance, next, turn] = trees.nodes[node];
    const auto place = std::lower_bound(used.begin(), used.end(), turn) - used.begin();
    row.entries.push_back(
        {hub, node, static_cast<float>(distance), static_cast<std::uint16_t>(place), corners});
  }
}

}  // namespace

std::vector<TileRow> hub_lists(const GridMap& ground, const NavigationMesh& mesh, const HubTrees& trees,
                               const TautDepartures& departures, std::size_t most_bytes,
                               const std::stop_token& stop) {
  return tile_rows<TileRow>(ground, most_bytes, stop, [&](int low_y) {
    TileRow row;
    std::vector<std::uint32_t> used;
    TileLabels<TautReach> labels(trees, TautReach(ground, mesh, departures));
    const auto add = [&](const std::vector<TileLabel>& list) { add_tile(list, mesh, trees, used, row); };
    each_tile(low_y, ground, labels, add);
    add({});  // the end of the last tile
    row.work = labels.work();
    row.entries.shrink_to_fit();
    row.turns.shrink_to_fit();
    row.tiles.shrink_to_fit();
    return row;
  });
}

}  // namespace outrider::hub_labelling
