// StoredIndex: the bytes of an index that a planner has built, kept for later runs.
//
// The bytes say for which planner, which options, which map and which costs they were made, by their hashes,
// and carry a version of the format and a checksum. They are read only where all of that agrees, so bytes
// that were cut, damaged or made for something else are refused, each with a sentence and its remedy. Equal
// indices have equal bytes. They are read where they lie, without a copy, so a file may be mapped
// (io/files/index_file.hpp).
//
// A checksum tells damage, not intent: whoever can write the bytes can make them give wrong paths, though
// none that reads outside of its memory. They hold numbers of this machine's byte order.
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "outrider/path/grid/grid_map.hpp"
#include "outrider/path/grid/terrain/cell_costs.hpp"

namespace outrider {

/// The ground for which an index is made.
struct IndexedGround {
  std::shared_ptr<const GridMap> grid;
  std::shared_ptr<const CellCosts> costs = nullptr;  ///< null: a metre costs 1; only some planners weigh them
};

struct StoredIndex {
  std::span<const std::byte> bytes;
  std::shared_ptr<const void> owner;  ///< keeps the bytes; the workspace that loads them holds it
};

}  // namespace outrider
