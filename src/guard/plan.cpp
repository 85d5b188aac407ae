#include "outrider/guard/plan.hpp"

#include <algorithm>

#include "draft.hpp"
#include "outrider/guard/bound.hpp"
#include "reason.hpp"

namespace outrider {
namespace {

/// Time of the plan if nothing goes wrong: turns, drives, aims and flights in their order.
double mission_time(const GuardProblem& problem, const GuardPlan& plan) {
  double time = 0.0;
  double heading = problem.start.heading_rad;
  double yaw = 0.0;  // of the gun, relative to the body
  double pitch = 0.0;
  for (const PlannedStop& stop : plan.stops) {
    const DriveCost drive = drive_cost(problem.robot, heading, stop.waypoints);
    time += drive.time_s;
    heading = drive.heading_rad;
    for (const PlannedHit& hit : stop.hits) {
      const Shot& shot = hit.shot.shot;
      const double relative = shot.yaw_rad - heading;
      time += aim_time(problem.gun, relative - yaw, shot.pitch_rad - pitch) + hit.shot.flight_s;
      yaw = relative;
      pitch = shot.pitch_rad;
    }
  }
  return time;
}

/// The stops of a draft with their shots, still without ways between them. The shots are solved again, as
/// they will be on the way, for the pitch at which the shot before leaves the barrel.
std::vector<PlannedStop> stops_of(const GuardProblem& problem, const Site& site, const Draft& draft,
                                  const ShotBook& book) {
  std::vector<PlannedStop> stops;
  double pitch = 0.0;
  for (const Visit& visit : draft.tour.visits) {
    const std::size_t cell = draft.cells[visit.stop];
    const bool at_start = visit.stop == 0;
    PlannedStop stop{at_start ? problem.start.position : site.frame.centre(site.frame.cell(cell)), {}, {}};
    for (const std::uint32_t goal : visit.goals) {
      const std::size_t target = draft.targets[goal];
      const auto shot =
          best_shot(site.rules, site.space(target), problem.targets[target], stop.position, pitch);
      stop.hits.push_back({target, shot ? *shot : *book.at({cell, target})});
      pitch = stop.hits.back().shot.shot.pitch_rad;
    }
    stops.push_back(std::move(stop));
  }
  return stops;
}

/// Joins the stops, from the start on, by the drives that are fastest with the turn before them.
Status join(const GuardProblem& problem, const Site& site, const Budget& budget, GuardPlan& plan) {
  std::vector<Vec2> places{problem.start.position};
  for (const PlannedStop& stop : plan.stops) places.push_back(stop.position);
  auto routes = site_routes(problem, site, places, budget);
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

Outcome<GuardPlan> plan_guard(const GuardProblem& problem, const Site& site, const GuardOptions& options,
                              const Budget& budget) {
  GuardPlan plan;
  for (const std::uint8_t cell : site.reachable) plan.places += cell;
  for (std::size_t t = 0; t < problem.targets.size(); ++t) {
    if (site.regions[t].hits > 0) continue;
    plan.unreachable.push_back({t, why_unreachable(problem, site, options, t)});
  }
  if (plan.unreachable.size() == problem.targets.size()) return plan;

  ShotBook book;
  const auto draft = draft_tour(problem, site, options, budget, book);
  if (!draft) return tl::unexpected(draft.error());
  for (std::size_t t = 0; t < problem.targets.size(); ++t) {
    const auto& planned = draft->targets;
    if (site.regions[t].hits == 0 || std::find(planned.begin(), planned.end(), t) != planned.end()) continue;
    plan.unreachable.push_back({t, "its only shots keep the margin by less than the contact tolerance"});
  }
  plan.stops = stops_of(problem, site, *draft, book);
  plan.tour_proven = draft->tour.proven_optimal;
  if (auto ok = join(problem, site, budget, plan); !ok) return pass_on(ok);
  plan.cost_s = mission_time(problem, plan);
  plan.lower_bound_s = mission_bound(problem, site);
  return plan;
}

}  // namespace outrider
