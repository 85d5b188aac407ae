#include "outrider/job/scene.hpp"

#include <utility>
#include <variant>

#include "outrider/log/messages/conversions.hpp"
#include "outrider/log/topics.hpp"

namespace outrider {

outrider_msgs::RunInfo run_info(std::string job, std::optional<std::uint64_t> seed, const World& world,
                                double robot_radius_m) {
  outrider_msgs::RunInfo info;
  info.job = std::move(job);
  info.seeded = seed.has_value();
  info.seed = seed.value_or(0);
  info.world = world.name;
  info.low = point_of(world.bounds.low);
  info.high = point_of(world.bounds.high);
  info.robot_radius = robot_radius_m;
  return info;
}

namespace {

bool rises_above_floor(const Solid& solid, const World& world) {
  return !std::holds_alternative<HalfSpaceShape>(solid.shape) && bounds(solid).high.z > world.floor_z_m;
}

}  // namespace

std::vector<RoundedPolygon> footprints_above_floor(const World& world) {
  std::vector<RoundedPolygon> all;
  for (const Solid& solid : world.solids) {
    if (!rises_above_floor(solid, world)) continue;
    const Box3 box = bounds(solid);
    for (RoundedPolygon& piece : footprint(solid, box.low.z, box.high.z)) all.push_back(std::move(piece));
  }
  return all;
}

void log_solids(Log& log, const World& world, double robot_height_m) {
  outrider_msgs::Solids solids;
  for (const Solid& solid : world.solids) {
    if (!rises_above_floor(solid, world)) continue;
    const Box3 box = bounds(solid);
    solids.solids.push_back({solid.name, std::string(kind(solid.shape)),
                             rounded_of(footprint(solid, box.low.z, box.high.z)), box.low.z, box.high.z,
                             box.low.z < world.floor_z_m + robot_height_m});
  }
  log.append(topic::solids, 0.0, std::move(solids));
}

void log_scene(Log& log, outrider_msgs::RunInfo info, const World& world, double robot_height_m) {
  log.append(topic::run, 0.0, std::move(info));
  log_solids(log, world, robot_height_m);
}

void log_zones(Log& log, const std::vector<Zone>& zones) {
  for (const auto& [kind, name] :
       {std::pair{Zone::Kind::keep_out, topic::keep_out}, {Zone::Kind::slow, topic::slow_zones}}) {
    outrider_msgs::Outlines message;
    for (const Zone& zone : zones) {
      if (zone.kind != kind) continue;
      for (const std::vector<Vec2>& ring : zone.rings) {
        outrider_msgs::Outline& outline = message.outlines.emplace_back();
        for (const Vec2 corner : ring) outline.points.push_back(point_of(corner));
      }
    }
    if (!message.outlines.empty()) log.append(name, 0.0, std::move(message));
  }
}

}  // namespace outrider
