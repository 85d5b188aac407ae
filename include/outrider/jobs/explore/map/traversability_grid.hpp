// TraversabilityGrid: the cells where a disk robot may stand, on a growing map.
//
// The centre of the robot may be in a cell that is known to be free and whose centre is farther than radius +
// margin from the square of every occupied cell. Unknown cells are blocked. Free cells nearer than `near_m`
// to the blocked belt are near a wall, where driving costs more. Both are counts of the occupied cells around
// a cell, so an update costs O(cells changed x cells of the disk) and equals a full computation.
//
// Two kinds of marks overrule the map. A cell is blocked where the disk would meet a point at which the robot
// touched something: the laser may see nothing there. Any other cell that was opened is not blocked,
// whatever the map says: the robot has been there, or finds out whether it fits. Marks do not move when the
// map is redrawn; their owner forgets them and sets them again.
//
// The grid has its own frame on the lattice of the map. It is at least two cells wider than the map on all
// sides, so it seldom changes and its border is always blocked. A second grid with cells twice as large and
// the same frame serves to estimate reachability: such a cell is free if any of its four cells is, so it
// connects whatever the fine grid does. Thread rule: one at a time.
#pragma once

#include <memory>
#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/geometry/convex.hpp"
#include "outrider/path/grid/grid_map.hpp"
#include "outrider/slam/map/occupancy_map.hpp"

namespace outrider {

/// Options of the grid.
struct KnownGroundOptions {
  /// Distance to occupied cells in addition to the radius of the robot. More than half a cell counts as that.
  double margin_m = 0.02;
  double near_m = 0.1;  ///< width of the belt beyond the margin in which driving costs more
};

/// Describes the options by name.
std::vector<Option> describe(KnownGroundOptions& options);

/// The grid.
class TraversabilityGrid {
 public:
  TraversabilityGrid(const KnownGroundOptions& options, double radius_m);

  /// The changes that an update made.
  struct Change {
    std::vector<std::uint32_t> cells;  ///< changed cells of the new frame()
    bool reframed = false;             ///< the frame has changed
    bool new_lattice = false;          ///< the lattice has changed, and all former knowledge is dropped
    Cell shift;                        ///< otherwise, former cell c is now c + shift
  };
  /// Applies the changes of the map. A redrawn map is compared with the known cells, O(cells).
  Change update(const Grid<std::uint8_t>& occupancy, const MapUpdate& update);

  [[nodiscard]] const GridFrame& frame() const { return known_.frame; }
  /// Returns the known cells as values of Occupancy.
  [[nodiscard]] const Grid<std::uint8_t>& known() const { return known_; }
  /// Returns true if the robot must not stand in the cell.
  [[nodiscard]] bool blocked(std::uint32_t cell) const {
    if (marks_[cell] != 0) return (marks_[cell] & (touched_mark | shut_mark)) != 0;
    return crowded(cell);
  }
  /// Returns true if the map alone blocks the cell.
  [[nodiscard]] bool crowded(std::uint32_t cell) const {
    return known_.cells[cell] != free_cell || touching_[cell] != 0;
  }
  /// Returns true if the robot would meet a point that it touched.
  [[nodiscard]] bool touched(std::uint32_t cell) const { return (marks_[cell] & touched_mark) != 0; }
  /// Returns the distance from the centre of a cell to the nearest square of an occupied cell, m, cut off at
  /// the radius of the robot, the margin and the belt. O(cells of the disk).
  [[nodiscard]] double clearance_m(Cell cell) const;
  /// Returns true if the cell is in the belt where driving costs more.
  [[nodiscard]] bool near_wall(std::uint32_t cell) const { return near_[cell] != 0; }
  /// Returns the number of cells that are known.
  [[nodiscard]] std::size_t known_cells() const { return known_cells_; }
  /// Return the corners of the box of all cells that were ever known. At first highest() is below lowest().
  [[nodiscard]] Cell lowest() const { return lowest_; }
  [[nodiscard]] Cell highest() const { return highest_; }

  /// Values of the coarse grid, whose cells have twice the side.
  enum Block : std::uint8_t { no_block = 0, near_block = 1, free_block = 2 };
  [[nodiscard]] const Grid<std::uint8_t>& blocks() const { return blocks_; }
  [[nodiscard]] std::uint32_t block_of(std::uint32_t cell) const;

  /// Returns a counter that increases with every change.
  [[nodiscard]] std::uint64_t clock() const { return clock_; }
  /// Returns the clock of the last change of known() or blocked() between two corners, or a later one: it is
  /// kept for tiles of 16 cells.
  [[nodiscard]] std::uint64_t changed_within(Cell low, Cell high) const;
  /// Counts as a change of the cell, without changing it.
  void note_change(std::uint32_t cell);

  static constexpr double touch_gap_m = 0.01;  ///< that the robot keeps from what it touched
  /// Blocks the cells nearer to the point than the radius and that gap. It may lie outside the frame.
  void mark_touched(Vec2 point);
  /// Blocks the cells whose centres are nearer to the point than `reach_m`, whatever the map shows: a gap
  /// there is too narrow.
  void mark_shut(Vec2 point, double reach_m);
  /// Opens the cells that the segment meets, but for those that are blocked by a touch, or shut. Returns true
  /// if one of them was not open before.
  bool mark_open(Segment way);
  /// Forgets all marks.
  void forget_marks();

  /// Returns the same grid for the path planners. Updates it by GridMap::with() if something changed.
  std::shared_ptr<const GridMap> grid();

 private:
  enum : std::uint8_t { touched_mark = 1, open_mark = 2, shut_mark = 4 };

  void reframe(const GridFrame& frame, Cell shift);
  void set(std::uint32_t cell, std::uint8_t value);
  void count(Cell around, int by);
  void mark(Cell cell, std::uint8_t mark);
  void mark_around(Vec2 point, double reach_m, std::uint8_t value);
  void settle(std::size_t from);
  [[nodiscard]] std::uint64_t& tile_of(Cell cell);

  double radius_m_;
  KnownGroundOptions options_;
  Grid<std::uint8_t> known_;
  std::size_t known_cells_ = 0;
  std::vector<std::uint16_t> touching_;  // occupied cells within radius + margin
  std::vector<std::uint16_t> near_;      // occupied cells within the belt as well
  std::vector<std::uint8_t> marks_;      // sums of touched_mark, open_mark and shut_mark
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
