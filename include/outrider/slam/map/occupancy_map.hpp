// OccupancyMap: a grid map of free and occupied cells, estimated from laser scans.
//
// Each cell holds the log odds of being occupied, in steps of 1/1024. A beam decreases those of the cells
// that it crosses and increases that of the cell in which it ends. A scan changes a cell at most once, and
// the end of a beam has priority. The cells crossed are exactly those whose interior the beam intersects,
// with its ends rounded to 1/512 of a cell. The log odds are bounded, so the map adapts when an obstacle
// moves. The grid grows by whole blocks of cells as needed: the lattice of the cells stays, but their indices
// change.
//
// insert() takes O(cells crossed), plus a visit of each cell of their bounding box. Equal scans give
// byte-identical maps. Thread rule: one call at a time.
// Sources: Moravec and Elfes, High resolution maps from wide angle sonar (1985); Amanatides and Woo, A fast
// voxel traversal algorithm for ray tracing (1987).
#pragma once

#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/geometry/pose.hpp"
#include "outrider/slam/scan/laser_scan.hpp"
#include "outrider/world/grid.hpp"
#include "outrider/world/occupancy.hpp"

namespace outrider {

/// Options of a map.
struct OccupancyMapOptions {
  double resolution_m = 0.05;   ///< side of a cell
  double hit_odds = 0.85;       ///< log odds added at the end of a beam
  double miss_odds = 0.4;       ///< log odds subtracted where a beam passes
  double most_odds = 3.5;       ///< bound of the absolute log odds
  double free_below = 0.0;      ///< log odds below which a cell counts as free; at most 0
  double occupied_above = 0.0;  ///< log odds above which a cell counts as occupied; at least 0
  friend bool operator==(const OccupancyMapOptions&, const OccupancyMapOptions&) = default;
};

std::vector<Option> describe(OccupancyMapOptions& options);

/// Refuses odds with which no cell would ever be free, or none occupied. Fault: bad_input.
Status check(const OccupancyMapOptions& options);

/// The changes of a map.
struct MapUpdate {
  bool redrawn = false;            ///< anything may have changed, also the frame: read the whole map again
  std::vector<std::size_t> cells;  ///< otherwise: the cells whose Occupancy changed, each once, ascending
};

/// A map as described above.
class OccupancyMap {
 public:
  /// Makes an empty map. A corner of the cell lattice lies at the origin of the world.
  explicit OccupancyMap(const OccupancyMapOptions& options);

  /// Inserts a scan taken at a pose. Ignores a scan that check() refuses, a pose that is not finite, and a
  /// scan that would enlarge the map beyond 1e8 cells.
  MapUpdate insert(const Pose2& world_T_laser, const LaserScan& scan);

  /// Returns the values of Occupancy. Everything outside the frame is unknown.
  [[nodiscard]] const Grid<std::uint8_t>& occupancy() const { return occupancy_; }
  [[nodiscard]] const GridFrame& frame() const { return occupancy_.frame; }
  /// Returns the log odds of a cell; 0 if it was never observed.
  [[nodiscard]] double log_odds(Cell cell) const;
  [[nodiscard]] const OccupancyMapOptions& options() const { return options_; }

 private:
  bool cover(Cell low, Cell high, bool& grown);
  void apply(std::size_t begin, std::size_t end, std::vector<std::size_t>& changed);

  OccupancyMapOptions options_;
  Grid<std::uint8_t> occupancy_;
  std::vector<std::int16_t> odds_;    ///< by cell
  std::vector<std::int16_t> change_;  ///< by cell: change of the odds by the present scan
  Cell low_;                          ///< position of cell (0, 0) on the lattice
};

}  // namespace outrider
