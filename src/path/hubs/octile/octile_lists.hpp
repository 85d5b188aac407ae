// Hub labels of all cells of a grid, for paths along the eight moves: the lists of tile_labels.hpp with exact
// distances.
//
// A query needs the hubs that two lists have in common. So the hubs are numbered such that those of a list
// have numbers close together: the most important ones first, the others along a curve through the grid that
// keeps neighbours together. A list then is a few blocks of 64 numbers with a bit for each hub, and two lists
// are intersected bit-parallel. Thread rule: read-only after construction.
#pragma once

#include <span>

#include "hubs/stored_array.hpp"
#include "hubs/tile_labels.hpp"
#include "subgoals.hpp"

namespace outrider::hub_labelling {

/// The path from a cell to a hub: a leg to a subgoal, diagonal first, and the path from there.
struct OctilePath {
  std::uint32_t node = 0;                    ///< node of the subgoal
  std::uint16_t straight = 0, diagonal = 0;  ///< moves from the subgoal to the hub
  std::int16_t x = 0, y = 0;                 ///< the subgoal
};

/// Returns the number of ones. std::popcount calls a library where no instruction for it may be assumed.
constexpr std::size_t ones(std::uint64_t bits) {
  bits -= (bits >> 1U) & 0x5555555555555555U;
  bits = (bits & 0x3333333333333333U) + ((bits >> 2U) & 0x3333333333333333U);
  bits = (bits + (bits >> 4U)) & 0x0F0F0F0F0F0F0F0FU;
  return static_cast<std::size_t>((bits * 0x0101010101010101U) >> 56U);
}

/// The hubs of a list whose number is 64 * block + bit. Where a hub has several paths, for different cells of
/// the tile, there are several blocks of the same number.
struct HubBlock {
  std::uint64_t bits = 0;
  std::uint32_t block = 0;
  std::uint32_t first = 0;  ///< index of the path of the lowest bit; the others follow

  /// Returns the index of the path of a hub, by its bit.
  [[nodiscard]] std::size_t path_of(std::uint64_t bit) const { return first + ones(bits & (bit - 1)); }
};

/// The lists of a row of tiles.
struct OctileTileRow {
  StoredArray<std::uint32_t> tiles;  ///< first block of each; one more at the end
  StoredArray<HubBlock> blocks;      ///< of each tile by number
  StoredArray<std::uint16_t> cells;  ///< by path: a bit for each cell to which it belongs
  StoredArray<OctilePath> paths;
  std::uint64_t work = 0;  ///< work of building it: labels and turns visited

  /// Returns the list of the tile of a cell.
  [[nodiscard]] std::span<const HubBlock> at(int x) const {
    const std::uint32_t* const tile = tiles.data() + x / tile_side;
    return {blocks.data() + tile[0], blocks.data() + tile[1]};
  }
  [[nodiscard]] std::size_t memory() const {
    return tiles.memory() + blocks.memory() + cells.memory() + paths.memory();
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
  StoredArray<OctileNode> nodes;
  std::vector<OctileTileRow> rows;
};

/// Builds the lists. Returns nothing if they do not keep the limits (tile_labels.hpp), if a path of the trees
/// has more than 65535 straight or diagonal moves, or if `stop` is requested.
std::optional<OctileLists> octile_lists(const GridMap& ground, const OctileRuns& runs,
                                        const Subgoals& subgoals, const HubTrees& trees,
                                        const ListLimits& limits, const std::stop_token& stop);

}  // namespace outrider::hub_labelling
