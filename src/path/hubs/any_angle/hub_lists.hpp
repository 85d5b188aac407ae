// Hub labels of all corners of a grid, for paths in any direction: the lists of tile_labels.hpp, each entry
// with its distance in single precision.
//
// Thread rule: read-only after construction.
#pragma once

#include <span>

#include "hubs/stored_array.hpp"
#include "hubs/tile_labels.hpp"
#include "hubs/turns/taut_departures.hpp"

namespace outrider::hub_labelling {

struct HubEntry {
  std::uint32_t hub = 0;      ///< its rank
  std::uint32_t node = 0;     ///< node of the turn on the path to the hub
  float beyond = 0.0F;        ///< distance from that turn to the hub, cells, rounded
  std::uint16_t turn = 0;     ///< index in TileList::turns
  std::uint16_t corners = 0;  ///< a bit for each corner to which the entry belongs
};

/// The list of a tile, ordered by rank of the hub.
struct TileList {
  std::span<const HubEntry> entries;
  std::span<const Cell> turns;
};

/// The lists of a row of tiles.
struct TileRow {
  struct Tile {
    std::uint32_t entries = 0, turns = 0;  ///< first of each
  };
  StoredArray<Tile> tiles;  ///< from the left, one more at the end
  StoredArray<HubEntry> entries;
  StoredArray<Cell> turns;
  std::uint64_t work = 0;  ///< work of building it: labels and turns visited

  [[nodiscard]] TileList at(int x) const {
    const Tile tile = tiles[static_cast<std::size_t>(x / tile_side)];
    const Tile next = tiles[static_cast<std::size_t>(x / tile_side) + 1];
    return {{entries.data() + tile.entries, entries.data() + next.entries},
            {turns.data() + tile.turns, turns.data() + next.turns}};
  }
  [[nodiscard]] std::size_t memory() const { return tiles.memory() + entries.memory() + turns.memory(); }
};

/// Builds the lists. Returns nothing if they do not keep the limits, or if `stop` is requested
/// (tile_labels.hpp).
std::optional<std::vector<TileRow>> hub_lists(const GridMap& ground, const NavigationMesh& mesh,
                                              const HubTrees& trees, const TautDepartures& departures,
                                              const ListLimits& limits, const std::stop_token& stop);

}  // namespace outrider::hub_labelling
