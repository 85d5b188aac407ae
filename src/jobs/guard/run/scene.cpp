#include "outrider/job/scene.hpp"
#include "outrider/job/scene_markers.hpp"
#include "outrider/log/messages/conversions.hpp"
#include "outrider/log/topics.hpp"
#include "run/guard_log.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "outrider/world/contours.hpp"
#include "outrider/world/steep_ground.hpp"

namespace outrider {
namespace {

outrider_msgs::Solid solid_entry(const Solid& solid, const World& world, double room_height_m) {
  constexpr double inf = std::numeric_limits<double>::infinity();
  const Box3 box = bounds(solid);
  const double floor = world.floor_z_m;
  const Interval under = world.terrain ? world.terrain->heights_over(box.ground()) : Interval{floor, floor};
  outrider_msgs::Solid entry{solid.name,
                             std::string(kind(solid.shape)),
                             rounded_of(footprint(solid, -inf, inf)),
                             box.low.z,
                             box.high.z,
                             !footprint(solid, under.low + 1e-3, under.high + room_height_m).empty()};
  if (!std::isfinite(entry.low_z)) entry.low_z = floor;  // the ground
  if (!std::isfinite(entry.high_z)) entry.high_z = floor;
  return entry;
}

/// Every so many-th post of a field with more of them than `most_posts`.
HeightField thinned(const HeightField& field, double most_posts) {
  const int step = static_cast<int>(std::ceil(std::sqrt(1.0 * field.columns() * field.rows() / most_posts)));
  const int columns = std::max(2, (field.columns() - 1) / step + 1);
  const int rows = std::max(2, (field.rows() - 1) / step + 1);
  if (step == 1 || (columns - 1) * step >= field.columns() || (rows - 1) * step >= field.rows()) return field;
  std::vector<double> heights;
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) heights.push_back(field.post(x * step, y * step).z);
  }
  return HeightField::make(field.bounds().low, static_cast<double>(step) * field.spacing_m(), columns, rows,
                           std::move(heights))
      .value();
}

outrider_msgs::Terrain terrain_entry(const HeightField& field, const RobotModel& robot) {
  constexpr double most_posts_of_lines = 40'000.0, most_posts_of_relief = 10'000.0;
  outrider_msgs::Terrain entry;
  entry.steep = rounded_of(steep_ground(field, robot.max_slope_rad));
  const HeightField relief = thinned(field, most_posts_of_relief);
  entry.origin = point_of(relief.bounds().low);
  entry.spacing = point_of(relief.spacing_m());
  entry.columns = static_cast<std::uint32_t>(relief.columns());
  entry.rows = static_cast<std::uint32_t>(relief.rows());
  for (int y = 0; y < relief.rows(); ++y) {
    for (int x = 0; x < relief.columns(); ++x) entry.heights.push_back(relief.post(x, y).z);
  }
  const HeightField drawn = thinned(field, most_posts_of_lines);
  for (const Contour& line : contours(drawn, contour_step(drawn))) {
    entry.contours.push_back({line.height_m, points_of(line.points)});
  }
  return entry;
}

outrider_msgs::Supplies supplies_entry(const Supplies& supplies) {
  outrider_msgs::Supplies entry{supplies.full(Store::water), supplies.full(Store::charge), {}};
  for (const Station& station : supplies.stations) {
    entry.stations.push_back(
        {station.name, point_of(station.position), station.gives_water, station.gives_charge});
  }
  return entry;
}

void log_run(Log& log, const GuardProblem& problem, const GuardScenario& scenario) {
  outrider_msgs::RunInfo info =
      run_info("guard", static_cast<std::uint64_t>(scenario.seed), problem.world, problem.robot.radius_m);
  if (scenario.sim == "physics") info.sim = "physics";
  info.gravity = problem.world.gravity_mps2;
  info.gun_length = std::hypot(problem.gun.tip_forward_m, problem.gun.tip_up_m);
  info.ball_radius = problem.gun.ball_radius_m;
  info.margin = scenario.options.margin_m;
  log.append(topic::run, 0.0, std::move(info));
}

void log_world(Log& log, const GuardProblem& problem) {
  outrider_msgs::Solids solids;
  for (const Solid& solid : problem.world.solids) {
    solids.solids.push_back(solid_entry(solid, problem.world, room_height(problem)));
  }
  log.append(topic::solids, 0.0, std::move(solids));
  if (problem.world.terrain)
    log.append(topic::terrain, 0.0, terrain_entry(*problem.world.terrain, problem.robot));
}

}  // namespace

void log_yard(Log& log, const GuardProblem& problem, const GuardScenario& scenario) {
  const bool first = log.latest<outrider_msgs::RunInfo>(topic::run) == nullptr;
  if (first) log_run(log, problem, scenario);
  if (first) log_world(log, problem);
  if (problem.supplies.any() && log.latest<outrider_msgs::Supplies>(topic::supplies) == nullptr)
    log.append(topic::supplies, 0.0, supplies_entry(problem.supplies));
  if (!first) return;
  std::vector<MarkerBox> targets;
  for (const Target& target : problem.targets) {
    targets.push_back({target.name, target.centre(), target.yaw_rad, target.size});
  }
  log_markers(log, targets);
}

}  // namespace outrider
