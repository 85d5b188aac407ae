// Hub labels of all corners of a grid at which a path may start or end, tile by tile.
//
// A corner reaches a hub over a turn that it sees: first the leg to the turn, then the path given by the
// label of the turn. For each hub the shortest path is kept, and only if no earlier hub lies on an equally
// short one. Two corners that do not see each other share a hub on a shortest path between them, unless they
// are not connected. The 16 corners of a tile have much in common, so they share a list in which each entry
// tells to which corners it belongs. Tiles are independent of each other. Thread rule: read-only after
// construction.
#pragma once

#include <span>

#include "hub_trees.hpp"

namespace outrider::hub_labelling {

inline constexpr int tile_side = 4;  // corners

struct HubEntry {
  std::uint32_t hub = 0;      ///< its rank
  std::uint32_t node = 0;     ///< node of the turn on the path to the hub
  float beyond = 0.0F;        ///< distance from that turn to the hub, cells, rounded
  std::uint16_t turn = 0;     ///< index in TileList::turns
  std::uint16_t corners = 0;  ///< a bit for each corner to which the entry belongs
};

/// Returns the bit of a corner in its tile.
inline unsigned corner_bit(Cell corner) {
  return 1U << static_cast<unsigned>(corner.y % tile_side * tile_side + corner.x % tile_side);
}

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
  std::vector<Tile> tiles;  ///< from the left, one more at the end; empty if the row was not built
  std::vector<HubEntry> entries;
  std::vector<Cell> turns;
  std::uint64_t work = 0;  ///< work of building it: labels and turns visited

  [[nodiscard]] TileList at(int x) const {
    const Tile tile = tiles[static_cast<std::size_t>(x / tile_side)];
    const Tile next = tiles[static_cast<std::size_t>(x / tile_side) + 1];
    return {{entries.data() + tile.entries, entries.data() + next.entries},
            {turns.data() + tile.turns, turns.data() + next.turns}};
  }
  [[nodiscard]] std::size_t memory() const {
    return tiles.capacity() * sizeof(Tile) + entries.capacity() * sizeof(HubEntry) +
           turns.capacity() * sizeof(Cell);
  }
};

/// Total of TileRow::work after which no more rows are built.
inline constexpr std::uint64_t most_work = std::uint64_t{1} << 34U;

/// Builds the rows from the lowest up, in parallel, as many as fit into `most_bytes` and `most_work`. Ends
/// early if `stop` is requested.
std::vector<TileRow> hub_lists(const GridMap& ground, const NavigationMesh& mesh, const HubTrees& trees,
                               std::size_t most_bytes, const std::stop_token& stop);

}  // namespace outrider::hub_labelling
