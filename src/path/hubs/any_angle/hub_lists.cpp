#include "hub_lists.hpp"

#include <algorithm>

#include "hubs/turns/taut_sight.hpp"

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

/// Builds a row of tiles.
class RowMaker {
 public:
  RowMaker(const NavigationMesh& mesh, const HubTrees& trees) : mesh_(mesh), trees_(trees) {}

  void add(const std::vector<TileLabel>& labels) {
    tiles_.push_back(
        {static_cast<std::uint32_t>(entries_.size()), static_cast<std::uint32_t>(turns_.size())});
    used_.clear();
    for (const TileLabel& label : labels) used_.push_back(trees_.nodes[label.node].turn);
    std::sort(used_.begin(), used_.end());
    used_.erase(std::unique(used_.begin(), used_.end()), used_.end());
    for (const std::uint32_t turn : used_) turns_.push_back(mesh_.turns[turn].at);
    for (const auto& [hub, node, corners] : labels) {
      const auto [distance, next, turn] = trees_.nodes[node];
      const auto place = std::lower_bound(used_.begin(), used_.end(), turn) - used_.begin();
      entries_.push_back(
          {hub, node, static_cast<float>(distance), static_cast<std::uint16_t>(place), corners});
    }
  }
  TileRow row(std::uint64_t work) && {
    add({});  // the end of the last tile
    return {StoredArray(std::move(tiles_)), StoredArray(std::move(entries_)), StoredArray(std::move(turns_)),
            work};
  }

 private:
  const NavigationMesh& mesh_;
  const HubTrees& trees_;
  std::vector<TileRow::Tile> tiles_;
  std::vector<HubEntry> entries_;
  std::vector<Cell> turns_;
  std::vector<std::uint32_t> used_;  ///< turns of the list
};

}  // namespace

std::optional<std::vector<TileRow>> hub_lists(const GridMap& ground, const NavigationMesh& mesh,
                                              const HubTrees& trees, const TautDepartures& departures,
                                              const ListLimits& limits, const std::stop_token& stop) {
  return tile_rows<TileRow>(ground, limits, stop, [&](std::span<const Cell> tiles) {
    RowMaker maker(mesh, trees);
    TileLabels<TautReach> labels(trees, TautReach(ground, mesh, departures));
    each_tile(tiles, ground, labels,
              [&](Cell /*low*/, const std::vector<TileLabel>& list) { maker.add(list); });
    return std::move(maker).row(labels.work());
  });
}

}  // namespace outrider::hub_labelling
