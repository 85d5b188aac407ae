// map_fit(): does a scan fit an occupancy map at a pose?
//
// Follows beams through the cells of the map. It uses ranges, cells and the pose only, so it judges poses
// that were found in any way. Source: Thrun, Burgard and Fox, Probabilistic Robotics (2005), section 6.3 (the
// parts of the beam model: hits, short readings, and readings beyond the map's surface).
#pragma once

#include <cstddef>
#include <cstdint>

#include "outrider/geometry/pose.hpp"
#include "outrider/slam/scan/laser_scan.hpp"
#include "outrider/world/grid.hpp"

namespace outrider {

/// The agreement of the beams of a scan with a map. Beams that may pass along a surface are not counted.
struct MapFit {
  std::size_t agreeing = 0;    ///< ends at a surface of the map
  std::size_t through = 0;     ///< passes through a surface of the map
  std::size_t unexpected = 0;  ///< ends where the map is free: a person, or something new
  std::size_t unknown = 0;     ///< leads through unknown cells, or beyond the map

  /// Returns the number of beams of which the map knows the whole way.
  [[nodiscard]] std::size_t beams() const { return agreeing + through + unexpected; }
  /// Returns the share of the beams that agree; 1 if there are none.
  [[nodiscard]] double share() const { return beams() == 0 ? 1.0 : of(agreeing); }
  /// Returns the share of the beams that pass through a surface; 0 if there are none.
  [[nodiscard]] double contradiction() const { return beams() == 0 ? 0.0 : of(through); }

 private:
  [[nodiscard]] double of(std::size_t part) const {
    return static_cast<double>(part) / static_cast<double>(beams());
  }
};

/// Follows at most 180 beams, evenly chosen, up to `reach_m`. A beam may end 0.2 m from a surface.
/// `occupancy` holds values of Occupancy; expects a scan that check() accepts. O(beams x cells of a beam).
MapFit map_fit(const Grid<std::uint8_t>& occupancy, const Pose2& grid_T_laser, const LaserScan& scan,
               double reach_m);

}  // namespace outrider
