// Questions about single beams of a scan.
#pragma once

#include <cstddef>

#include "outrider/slam/scan/laser_scan.hpp"

namespace outrider {

/// Returns the range of a reading, infinite if nothing is in range, or a negative number if it says nothing.
double range_of(const LaserScan& scan, std::size_t beam);

/// Returns true if the last beam is beside the first.
bool is_whole_turn(const LaserScan& scan);

/// Returns true if a beam at about that bearing says something.
bool looks_at(const LaserScan& scan, double bearing_rad);

/// Returns true if the beam at that bearing and those beside it, at least one on each side and all within
/// `beside_rad`, end beyond a range; false where the laser does not look.
bool passes(const LaserScan& scan, double bearing_rad, double beyond_m, double beside_rad = 0.0);

/// Returns true if a beam beside this one has a range that differs by at most `within_m`.
bool has_neighbour(const LaserScan& scan, std::size_t beam, double within_m);

}  // namespace outrider
