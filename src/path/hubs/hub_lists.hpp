// Hub labels of all corners of a grid at which a path may start or end, tile by tile.
//
// A corner reaches a hub over a turn that it sees: the way to the turn, and on along the turn's label. Of
// each hub the shortest way is kept, and only when no earlier hub lies on one as short. Two corners that do
// not see each other share a hub on a shortest path between them, or nothing joins them. The 16 corners of a
// tile have much in common, so they share a list, in which each entry tells whose it is. Tiles do not depend
// on one another. Thread rule: read only once made.
#pragma once

#include <span>

#include "hub_trees.hpp"

namespace outrider::hub_labelling {

inline constexpr int tile_side = 4;  // corners

struct HubEntry {
  std::uint32_t hub = 0;      ///< its rank
  std::uint32_t node = 0;     ///< of the turn on the way there
  float beyond = 0.0F;        ///< from that turn to the hub, cells, rounded
  std::uint16_t turn = 0;     ///< of TileList::turns
  std::uint16_t corners = 0;  ///< a bit for each whose entry it is
};

/// The bit of a corner in its tile.
inline unsigned corner_bit(Cell corner) {
  return 1U << static_cast<unsigned>(corner.y % tile_side * tile_side + corner.x % tile_side);
}

/// By rank of the hub.
struct TileList {
  std::span<const HubEntry> entries;
  std::span<const Cell> turns;
};

/// The lists of a row of tiles.
struct TileRow {
  struct Tile {
    std::uint32_t entries = 0, turns = 0;  ///< first of each
  };
  std::vector<Tile> tiles;  ///< from the left, one more at the end; none when the row was not made
  std::vector<HubEntry> entries;
  std::vector<Cell> turns;
  std::uint64_t work = 0;  ///< of its making: labels and turns looked at

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

/// TileRow::work after which no more rows are made.
inline constexpr std::uint64_t most_work = std::uint64_t{1} << 34U;

/// Row by row from below, in parallel, as many as fit into `most_bytes` and are made with `most_work`. Cut
/// short when `stop` asks for it.
std::vector<TileRow> hub_lists(const GridMap& ground, const NavigationMesh& mesh, const HubTrees& trees,
                               std::size_t most_bytes, const std::stop_token& stop);

}  // namespace outrider::hub_labelling
