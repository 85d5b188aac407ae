// TraversabilityGrid: where a disk robot may go on a map that still grows.
//
// The centre of the robot may stand on a cell that is known to be free and whose centre is farther than
// radius + margin from the centre of every occupied cell; unknown cells are blocked. Cells from there to the
// distance `near_m` beyond are free but near a wall, where driving costs more. Both are kept as counts of the
// occupied cells around, so an update costs O(cells changed x cells of the disk) and equals a full
// computation.
//
// The ground has a frame of its own on the lattice of the map, wider than the map by at least two cells all
// around, so that it seldom changes and its border is always blocked. A second grid of cells twice as large,
// of the same frame, serves for estimates of reach: such a cell is free when any of its four cells is, so it
// joins whatever the fine one joins.
// Thread rule: one at a time.
#pragma once

#include <memory>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/path/grid/grid_map.hpp"
#include "outrider/slam/occupancy_map.hpp"

namespace outrider {

struct KnownGroundOptions {
  double margin_m = 0.045;  ///< kept from occupied cells beyond the radius of the robot
  double near_m = 0.1;      ///< beyond the margin, the belt in which driving costs more
};

std::vector<Option> describe(KnownGroundOptions& options);

class TraversabilityGrid {
 public:
  TraversabilityGrid(const KnownGroundOptions& options, double radius_m);

  /// What an update changed: cells of frame() as it is then.
  struct Change {
    std::vector<std::uint32_t> cells;
    bool reframed = false;
    bool anew = false;  ///< reframed on another lattice: what was known before is forgotten
    Cell shift;         ///< else what was cell c is now c + shift
  };
  /// Takes over what changed on the map. A redrawn map is compared with what was known, O(cells).
  Change update(const Grid<std::uint8_t>& occupancy, const MapUpdate& update);

  [[nodiscard]] const GridFrame& frame() const { return known_.frame; }
  /// Values of Occupancy.
  [[nodiscard]] const Grid<std::uint8_t>& known() const { return known_; }
  [[nodiscard]] bool blocked(std::uint32_t cell) const {
    return known_.cells[cell] != free_cell || touching_[cell] != 0;
  }
  [[nodiscard]] bool near_wall(std::uint32_t cell) const { return near_[cell] != 0; }
  /// Of the cells that were ever known; highest below lowest at first.
  [[nodiscard]] Cell lowest() const { return lowest_; }
  [[nodiscard]] Cell highest() const { return highest_; }

  /// Cells of twice the side.
  enum Block : std::uint8_t { no_block = 0, near_block = 1, free_block = 2 };
  [[nodiscard]] const Grid<std::uint8_t>& blocks() const { return blocks_; }
  [[nodiscard]] std::uint32_t block_of(std::uint32_t cell) const;

  /// Goes up with every change.
  [[nodiscard]] std::uint64_t clock() const { return clock_; }
  /// The clock at the last change of known() or blocked() between two corners, or later: by tiles of 16
  /// cells.
  [[nodiscard]] std::uint64_t changed_within(Cell low, Cell high) const;
  /// Counts as a change of the cell.
  void touch(std::uint32_t cell);

  /// The same for the path planners. Made anew when something changed, by GridMap::with().
  std::shared_ptr<const GridMap> grid();

 private:
  void reframe(const GridFrame& frame, Cell shift);
  void set(std::uint32_t cell, std::uint8_t value);
  void count(Cell around, int by);
  void settle(std::size_t from);
  [[nodiscard]] std::uint64_t& tile_of(Cell cell);

  double radius_m_;
  KnownGroundOptions options_;
  Grid<std::uint8_t> known_;
  std::vector<std::uint16_t> touching_;  // occupied cells within radius + margin
  std::vector<std::uint16_t> near_;      // occupied cells within the belt as well
  std::vector<Cell> disk_;               // offsets; the first `touch_` of them touch
  std::size_t touch_ = 0;
  Grid<std::uint8_t> blocks_;
  std::uint64_t clock_ = 0;
  std::vector<std::uint64_t> tiles_;  // clock of the last change, by rows
  Cell lowest_{0, 0}, highest_{-1, -1};
  std::shared_ptr<const GridMap> grid_;
  std::vector<std::uint32_t> stale_;  // cells that may have become free or blocked since grid_
};

}  // namespace outrider
