// OccupancyMap: which places are free and which are occupied, learnt from range scans.
//
// Each cell holds the log odds of being occupied, in steps of 1/1024. A beam lowers those of the cells that
// it crosses and raises that of the cell in which it ends; a cell is changed at most once by a scan, and the
// end of a beam wins. The cells crossed are exactly those whose interior the beam meets, its ends rounded to
// 1/512 of a cell. Odds are bounded, so that a map unlearns what has moved. The grid grows with what is seen,
// by whole blocks of cells: the lattice stays, the numbers of the cells then change.
//
// insert(): O(cells crossed), and a look at each cell of the box around them. Same scans, same bytes.
// Thread rule: one at a time.
// Sources: Moravec and Elfes, High resolution maps from wide angle sonar (1985); Amanatides and Woo, A fast
// voxel traversal algorithm for ray tracing (1987).
#pragma once

#include <vector>

#include "outrider/core/options.hpp"
#include "outrider/geometry/pose.hpp"
#include "outrider/slam/laser_scan.hpp"
#include "outrider/world/grid.hpp"
#include "outrider/world/occupancy.hpp"

namespace outrider {

struct OccupancyMapOptions {
  double resolution_m = 0.05;
  double hit_odds = 0.85;       ///< log odds that a beam's end adds
  double miss_odds = 0.4;       ///< log odds that a beam's passing takes
  double most_odds = 3.5;       ///< bound of the log odds to both sides
  double free_below = 0.0;      ///< log odds below which a cell counts as free; at most 0
  double occupied_above = 0.0;  ///< log odds above which a cell counts as occupied; at least 0
  friend bool operator==(const OccupancyMapOptions&, const OccupancyMapOptions&) = default;
};

std::vector<Option> describe(OccupancyMapOptions& options);

/// What changed on a map.
struct MapUpdate {
  bool redrawn = false;            ///< anything may have changed, the frame too: begin anew
  std::vector<std::size_t> cells;  ///< else: the cells whose Occupancy changed, each once, ascending
};

class OccupancyMap {
 public:
  /// Options as described. A lattice point of the cells lies at the origin of the world.
  explicit OccupancyMap(const OccupancyMapOptions& options);

  /// Left out: a scan that check() refuses, one from nowhere, one that would take the map beyond 1e8 cells.
  MapUpdate insert(const Pose2& world_T_laser, const LaserScan& scan);

  /// Values of Occupancy; outside the frame all is unknown.
  [[nodiscard]] const Grid<std::uint8_t>& occupancy() const { return occupancy_; }
  [[nodiscard]] const GridFrame& frame() const { return occupancy_.frame; }
  /// 0 where nothing was seen.
  [[nodiscard]] double log_odds(Cell cell) const;
  [[nodiscard]] const OccupancyMapOptions& options() const { return options_; }

 private:
  bool cover(Cell low, Cell high, bool& grown);
  void apply(std::size_t begin, std::size_t end, std::vector<std::size_t>& changed);

  OccupancyMapOptions options_;
  Grid<std::uint8_t> occupancy_;
  std::vector<std::int16_t> odds_;    ///< by cell
  std::vector<std::int16_t> change_;  ///< by cell: what the scan at work does to the odds
  Cell low_;                          ///< of cell (0, 0), on the lattice
};

}  // namespace outrider
