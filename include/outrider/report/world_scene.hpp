// The part of a report that stands still: world, robot and start.
#pragma once

#include <cstdint>
#include <string>

#include "outrider/report/report.hpp"
#include "outrider/world/world.hpp"

namespace outrider {

/// A report of that job with world, start and the robot's disk. Solids that rise above the floor are drawn;
/// those that begin below `robot_height_m` above it stand in the way of the robot. O(solids).
Report world_scene(const std::string& job, std::uint64_t seed, const World& world, const Pose2& start,
                   double robot_radius_m, double robot_height_m);

}  // namespace outrider
