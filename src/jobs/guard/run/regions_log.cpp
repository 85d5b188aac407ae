#include <algorithm>
#include <cmath>
#include <utility>

#include "outrider/log/messages/conversions.hpp"
#include "outrider/log/messages/gun_messages.hpp"
#include "outrider/log/topics.hpp"
#include "outrider/sim/simulated_gun.hpp"
#include "run/guard_log.hpp"

namespace outrider {
namespace {

nav_msgs::OccupancyGrid blank_grid(const Log& log, const GridFrame& frame, double time_s) {
  nav_msgs::OccupancyGrid grid;
  grid.header = header_of(log.time_of(time_s), "map");
  grid.info = {{},
               static_cast<float>(frame.resolution_m),
               static_cast<std::uint32_t>(frame.width),
               static_cast<std::uint32_t>(frame.height),
               pose_of(Pose2{frame.origin, 0.0})};
  return grid;
}

}  // namespace

void log_firing_regions(Log& log, const GuardProblem& problem, const FiringMap& firing_map, double time_s) {
  const GridFrame& frame = firing_map.frame;
  for (std::size_t t = 0; t < firing_map.regions.size(); ++t) {
    const FiringRegion& region = firing_map.regions[t];
    outrider_msgs::FiringRegion message{problem.targets[t].name, blank_grid(log, frame, time_s)};
    for (std::size_t i = 0; i < frame.size(); ++i) {
      const bool hits = region.pitch[i] != FiringRegion::no_shot;
      const double forgiven =
          hits ? 100.0 * std::clamp(1.0 - static_cast<double>(region.error_ratio[i]), 0.01, 1.0) : 0.0;
      message.grid.data.push_back(
          static_cast<std::int8_t>(firing_map.reachable[i] != 0 ? std::lround(forgiven) : -1));
    }
    log.append(topic::firing_regions, time_s, std::move(message));
  }
}

void log_firing_map(Log& log, const FiringMap& firing_map, double time_s) {
  nav_msgs::OccupancyGrid grid = blank_grid(log, firing_map.frame, time_s);
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
