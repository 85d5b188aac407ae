// Functions that log what stands still in a run: the job, the world and its solids.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "outrider/log/log.hpp"
#include "outrider/log/messages/scene_messages.hpp"
#include "outrider/world/world.hpp"
#include "outrider/world/zone.hpp"

namespace outrider {

/// Returns the description of a run in a world, with a robot that is a disk. No seed: nothing is drawn at
/// random.
outrider_msgs::RunInfo run_info(std::string job, std::optional<std::uint64_t> seed, const World& world,
                                double robot_radius_m);

/// Returns the footprints of the solids that rise above the floor, each over its whole height. O(solids).
std::vector<RoundedPolygon> footprints_above_floor(const World& world);

/// Logs the solids of the world that rise above the floor. Those that begin below `robot_height_m` above the
/// floor block the robot. O(solids).
void log_solids(Log& log, const World& world, double robot_height_m);

/// Logs the description and the solids.
void log_scene(Log& log, outrider_msgs::RunInfo info, const World& world, double robot_height_m);

/// Logs the outlines of zones at time 0, those of each kind, if there are any.
void log_zones(Log& log, const std::vector<Zone>& zones);

}  // namespace outrider
