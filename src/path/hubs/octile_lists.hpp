// Hub labels of all cells of a grid, for paths along the eight moves: the lists of tile_labels.hpp with exact
// distances.
//
// A query merges two lists by hub; the rest of an entry is read only where both have the hub. So hubs,
// bits of the cells and the rest are stored apart. Thread rule: read-only after construction.
#pragma once

#include <span>

#include "subgoals.hpp"
#include "tile_labels.hpp"

namespace outrider::hub_labelling {

/// The path from a cell to a hub: a leg to a subgoal, diagonal first, and the path from there.
struct OctilePath {
  std::uint32_t node = 0;                    ///< node of the subgoal
  std::uint16_t straight = 0, diagonal = 0;  ///< moves from the subgoal to the hub
  std::int16_t x = 0, y = 0;                 ///< the subgoal
};

/// The list of a tile, ordered by rank of the hub.
struct OctileList {
  std::span<const std::uint32_t> hubs;   ///< ranks
  const std::uint16_t* cells = nullptr;  ///< by hub: a bit for each cell to which the entry belongs
  const OctilePath* paths = nullptr;     ///< by hub
};

/// The lists of a row of tiles.
struct OctileTileRow {
  std::vector<std::uint32_t> tiles;  ///< first entry of each; one more at the end; empty if not built
  std::vector<std::uint32_t> hubs;
  std::vector<std::uint16_t> cells;
  std::vector<OctilePath> paths;
  std::uint64_t work = 0;  ///< work of building it: labels and turns visited

  [[nodiscard]] OctileList at(int x) const {
    const std::uint32_t first = tiles[static_cast<std::size_t>(x / tile_side)];
    const std::uint32_t end = tiles[static_cast<std::size_t>(x / tile_side) + 1];
    return {{hubs.data() + first, hubs.data() + end}, cells.data() + first, paths.data() + first};
  }
  [[nodiscard]] std::size_t memory() const {
    return (tiles.capacity() + hubs.capacity()) * sizeof(std::uint32_t) +
           cells.capacity() * sizeof(std::uint16_t) + paths.capacity() * sizeof(OctilePath);
  }
};

/// A node of the trees without its distance.
struct OctileNode {
  std::uint32_t next = 0;     ///< node towards the hub; itself there
  std::int16_t x = 0, y = 0;  ///< the subgoal

  [[nodiscard]] Cell cell() const { return {x, y}; }
};

/// The index of a ground.
struct OctileLists {
  std::vector<OctileNode> nodes;
  std::vector<OctileTileRow> rows;
};

/// Builds the rows of tiles, as many as fit into `most_bytes` (tile_labels.hpp). Returns nothing if a path of
/// the trees has more than 65535 straight or diagonal moves.
std::optional<OctileLists> octile_lists(const GridMap& ground, const Subgoals& subgoals,
                                        const HubTrees& trees, std::size_t most_bytes,
                                        const std::stop_token& stop);

}  // namespace outrider::hub_labelling
