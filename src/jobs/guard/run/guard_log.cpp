#include "run/guard_log.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "outrider/job/grid_message.hpp"
#include "outrider/job/scene.hpp"
#include "outrider/job/scene_markers.hpp"
#include "outrider/log/messages/conversions.hpp"
#include "outrider/log/messages/gun_messages.hpp"
#include "outrider/log/topics.hpp"
#include "outrider/sim/simulated_gun.hpp"
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

void log_firing_regions(Log& log, const GuardProblem& problem, const FiringMap& firing_map, double time_s) {
  const GridFrame& frame = firing_map.frame;
  for (std::size_t t = 0; t < firing_map.regions.size(); ++t) {
    const FiringRegion& region = firing_map.regions[t];
    outrider_msgs::FiringRegion message{problem.targets[t].name,
                                        grid_message(frame, 0.0, log.time_of(time_s))};
    for (std::size_t i = 0; i < frame.size(); ++i) {
      const bool hits = firing_map.has_shot(t, i);
      const double forgiven =
          hits ? 100.0 * std::clamp(1.0 - static_cast<double>(region.error_ratio[i]), 0.01, 1.0) : 0.0;
      message.grid.data.push_back(
          static_cast<std::int8_t>(firing_map.reachable[i] != 0 ? std::lround(forgiven) : -1));
    }
    log.append(topic::firing_regions, time_s, std::move(message));
  }
}

void log_firing_map(Log& log, const FiringMap& firing_map, double time_s) {
  auto grid = grid_message(firing_map.frame, 0.0, log.time_of(time_s));
  const auto targets = static_cast<double>(firing_map.regions.size());
  for (std::size_t i = 0; i < firing_map.frame.size(); ++i) {
    const auto hit = std::ranges::count_if(firing_map.regions, [i](const FiringRegion& region) {
      return region.hits > 0 && region.pitch[i] != FiringRegion::no_shot;
    });
    const double percent = std::ceil(100.0 * static_cast<double>(hit) / targets);
    grid.data.push_back(static_cast<std::int8_t>(firing_map.reachable[i] != 0 ? percent : -1.0));
  }
  log.append(topic::firing_map, time_s, std::move(grid));
}

void log_blocked_flights(Log& log, const GuardProblem& problem, const FiringMap& firing_map, double time_s) {
  for (std::size_t t = 0; t < problem.targets.size(); ++t) {
    const std::optional<BlockedFlight>& blocked = firing_map.no_shots[t].blocked;
    if (!blocked) continue;
    const FlightSpace& space = firing_map.space(t);
    const Target& target = problem.targets[t];
    const Flight flight = launch(firing_map.rules, {blocked->position, {}}, target, blocked->shot);
    outrider_msgs::Shot shot = shot_message(flight, blocked->impact, space, target, problem.gun.ball_radius_m,
                                            space.solids()[blocked->solid].name);
    shot.target = target.name;
    shot.attempt = 0;
    shot.hit = false;
    shot.contact_point = point_of(blocked->at);
    set_pose(shot, {blocked->position, blocked->shot.yaw_rad}, blocked->shot.yaw_rad,
             blocked->shot.pitch_rad);
    log.append(topic::blocked_flights, time_s, std::move(shot));
  }
}

void log_tour(Log& log, const GuardProblem& problem, const TourDraft& tour, double time_s) {
  outrider_msgs::Tour message{{}, points_of(tour.way), tour.cost_s, tour.lower_bound_s};
  for (const DraftStop& stop : tour.stops) {
    outrider_msgs::TourStop& told = message.stops.emplace_back();
    told.position = point_of(stop.position);
    for (const std::size_t target : stop.targets) told.targets.push_back(problem.targets[target].name);
  }
  log.append(topic::tours, time_s, std::move(message));
}

}  // namespace outrider
