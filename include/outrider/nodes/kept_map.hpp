// KeptMap: a map that a mapper keeps in files, so that one that is started anew goes on with it.
//
// Beside the map as map_server has it (map.yaml, map.pgm), map.state says when the map was begun and where
// the odometry is on it, and map.mcap has the scans of its keyframes with their poses, so that loops close
// between what was mapped before and after. The four are written so that a reader finds all or those before.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "outrider/core/outcome.hpp"
#include "outrider/geometry/pose.hpp"
#include "outrider/slam/laser/laser_slam.hpp"
#include "outrider/world/grid.hpp"

namespace outrider {

/// A scan and where it was taken.
struct KeptScan {
  Pose2 map_T_robot;
  LaserScan scan;
};

struct KeptMap {
  Grid<std::uint8_t> occupancy;
  double begun_s = 0.0;  ///< when the map was begun
  Pose2 map_T_odom;
  std::vector<KeptScan> scans;  ///< of the keyframes, in the order in which they were taken
};

/// Writes the files; `path` ends in .yaml. Fault: cannot_write.
Status save(const std::string& path, const KeptMap& map);

/// Reads the files; nothing if there is no map.state, and no scans if there is no map.mcap. Faults: bad_input
/// with file, line or key.
Outcome<std::optional<KeptMap>> load_kept_map(const std::string& path);

/// Returns map_T_robot where the scan fits the map best, within 0.25 m and 0.15 rad of where the odometry
/// says that the robot is. Nothing if it fits badly there: it must have at least 20 beams whose way the map
/// knows, of which 70 % end at its walls, and at most 10 % pass through walls. O(cells + poses x beams).
std::optional<Pose2> place_on(const KeptMap& map, const Pose2& odom_T_robot, const LaserScan& scan,
                              const LaserSlamOptions& options);

/// Returns both maps as one, on the same lattice of cells: the newer where it knows a cell.
Grid<std::uint8_t> overlaid(const Grid<std::uint8_t>& older, const Grid<std::uint8_t>& newer);

}  // namespace outrider
