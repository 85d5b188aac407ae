#include "assemble.hpp"

#include <algorithm>

#include "outrider/ballistics/stance.hpp"
#include "reason.hpp"

namespace outrider {
namespace {

/// Joins the stops, from the start on, by the drives that are fastest with the turn before them.
Status join(const GuardProblem& problem, const FiringMap& firing_map, const Budget& budget, GuardPlan& plan) {
  std::vector<Vec2> places{problem.start.position};
  for (const PlannedStop& stop : plan.stops) places.push_back(stop.position);
  auto routes = yard_routes(problem, firing_map, places, budget);
  if (!routes) return pass_on(routes);
  double heading = problem.start.heading_rad;
  for (std::size_t i = 0; i < plan.stops.size(); ++i) {
    auto route = routes->route({places[i], heading}, places[i + 1]);
    auto& way = plan.stops[i].waypoints;
    way = route ? std::move(route->waypoints) : routes->waypoints(i, i + 1);
    heading = drive_cost(problem.robot, heading, way).heading_rad;
  }
  plan.routes = std::move(*routes);
  return {};
}

}  // namespace

GuardPlan begin_plan(const GuardProblem& problem, const FiringMap& firing_map, const GuardOptions& options) {
  GuardPlan plan;
  for (const std::uint8_t cell : firing_map.reachable) plan.places += cell;
  for (std::size_t t = 0; t < problem.targets.size(); ++t) {
    if (firing_map.regions[t].hits > 0) continue;
    plan.unreachable.push_back({t, why_unreachable(problem, firing_map, options, t)});
  }
  return plan;
}

double mission_time(const GuardProblem& problem, const FiringMap& firing_map, const GuardPlan& plan) {
  double time = 0.0;
  double heading = problem.start.heading_rad;
  GunState gun;
  double gun_free = 0.0;  // since when the gun may turn to the next shot
  double landed = 0.0;    // the last ball
  for (const PlannedStop& stop : plan.stops) {
    const DriveCost drive = drive_cost(problem.robot, heading, stop.waypoints, firing_map.ground.terrain());
    if (!stop.passing.empty()) gun_free = time + stop.passing.back().leaves_s;
    landed = std::max(landed, time + last_landing_s(stop.passing));
    gun = gun_after(stop.waypoints, stop.passing, gun);
    time += drive.time_s;
    heading = drive.heading_rad;
    const double forward = heading_on(stance_at(firing_map.rules, stop.position), heading);
    for (const PlannedHit& hit : stop.hits) {
      const GunState to{hit.shot.gun.yaw_rad - forward, hit.shot.gun.pitch_rad};
      const double aim = aim_time(problem.gun, to.yaw_rad - gun.yaw_rad, to.pitch_rad - gun.pitch_rad);
      gun = to;
      time = plan.on_the_move ? std::max(time, gun_free + aim) : time + aim;
      landed = std::max(landed, time + hit.shot.flight_s);
      if (!is_left_flying(plan, hit.shot)) time += hit.shot.flight_s;
      gun_free = time;
    }
  }
  return std::max(time, landed);
}

Status finish_plan(const GuardProblem& problem, const FiringMap& firing_map, const Budget& budget,
                   GuardPlan& plan) {
  if (auto ok = join(problem, firing_map, budget, plan); !ok) return ok;
  plan.cost_s = mission_time(problem, firing_map, plan);
  return {};
}

}  // namespace outrider
