// Does the path lead through what the map shows as occupied?
//
// A robot does not drive through walls. Where a map is folded, because the robot was recognised at a place
// that only looks alike, its rooms lie on each other and the path of one leads through the walls of another,
// although no two scans saw the same place. Of five logs of real robots in buildings no path meets an
// occupied cell.
//
// A door that was closed for a while and stands open again is no wall, though the map may still show it: what
// the newest two scans that can tell have looked through does not count.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "outrider/geometry/pose.hpp"
#include "outrider/slam/map/map_check.hpp"
#include "outrider/world/grid.hpp"

namespace outrider {

/// Returns the numbers of the poses to which the straight way from the pose before leads through an occupied
/// cell; ways of more than 1 m are left out, since the robot may have driven around a corner. `scans` are
/// those of the map, in their order. O(poses + cells on the path + crossings * scans).
std::vector<std::size_t> wall_crossings(const std::vector<Pose2>& path, const Grid<std::uint8_t>& occupancy,
                                        std::span<const PlacedScan> scans);

}  // namespace outrider
