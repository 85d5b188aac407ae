#include "outrider/report/world_scene.hpp"

#include <variant>

namespace outrider {

Report world_scene(const std::string& job, std::uint64_t seed, const World& world, const Pose2& start,
                   double robot_radius_m, double robot_height_m) {
  Report report;
  report.job = job;
  report.seed = seed;
  report.world_name = world.name;
  report.bounds = world.bounds;
  report.robot_radius_m = robot_radius_m;
  report.start = start;
  for (const Solid& solid : world.solids) {
    const Box3 box = bounds(solid);
    const bool floor = std::holds_alternative<HalfSpaceShape>(solid.shape);
    if (floor || box.high.z <= world.floor_z_m) continue;
    report.solids.push_back({solid.name, std::string(kind(solid.shape)),
                             footprint(solid, box.low.z, box.high.z), box.low.z, box.high.z,
                             box.low.z < world.floor_z_m + robot_height_m});
  }
  return report;
}

}  // namespace outrider
