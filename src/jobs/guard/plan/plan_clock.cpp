#include "plan/plan_clock.hpp"

#include <algorithm>

#include "outrider/jobs/guard/yard/firing_map.hpp"

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

PlanClock::PlanClock(const GuardProblem& problem, const FiringMap& firing_map, const GuardPlan& plan)
    : problem_(problem),
      firing_map_(firing_map),
      plan_(plan),
      heading_rad_(problem.start.heading_rad),
      level_{0.0, problem.supplies.full(Store::water), problem.supplies.full(Store::charge), 0.0} {}

void PlanClock::make_stop(double begin_s) {
  const PlannedStop& stop = plan_.stops[stops_made_++];
  const double before_s = time_s_;
  time_s_ = std::max(time_s_, begin_s);
  const DriveCost drive =
      drive_cost(problem_.robot, heading_rad_, stop.waypoints, firing_map_.ground.terrain());
  if (!stop.passing.empty()) gun_free_s_ = time_s_ + stop.passing.back().leaves_s;
  landed_s_ = std::max(landed_s_, time_s_ + last_landing_s(stop.passing));
  gun_ = gun_after(stop.passing, gun_);
  time_s_ += drive.time_s;
  heading_rad_ = drive.heading_rad;
  for (const PlannedHit& hit : stop.hits) {
    aim(joints_of(firing_map_, {stop.position, heading_rad_}, hit.shot.gun));
    landed_s_ = std::max(landed_s_, time_s_ + hit.shot.flight_s);
    if (is_awaited(hit.shot, plan_.on_the_move)) time_s_ += hit.shot.flight_s;
    gun_free_s_ = time_s_;
  }
  if (stop.call) aim({});
  use(time_s_ - before_s, drive.driven_m, stop.passing.size() + stop.hits.size());
  if (stop.call) fill(stop.call->store);
}

/// Turns the gun, which on the move has turned since it was free.
void PlanClock::aim(GunState to) {
  const double aim = aim_time(problem_.gun, to.yaw_rad - gun_.yaw_rad, to.pitch_rad - gun_.pitch_rad);
  gun_ = to;
  time_s_ = plan_.on_the_move ? std::max(time_s_, gun_free_s_ + aim) : time_s_ + aim;
}

void PlanClock::use(double seconds, double metres, std::size_t shots) {
  const Supplies& supplies = problem_.supplies;
  level_.time_s = time_s_;
  level_.filling_s = 0.0;
  level_.charge -= supplies.charge_of(seconds, metres) + static_cast<double>(shots) * supplies.shot_j;
  level_.water -= static_cast<double>(shots) * supplies.shot_water;
}

void PlanClock::fill(Store store) {
  const Supplies& supplies = problem_.supplies;
  double& level = store == Store::water ? level_.water : level_.charge;
  const double full = supplies.full(store);
  level_.filling_s = supplies.filling_s(store, full - level);
  level = full;
  time_s_ += level_.filling_s;
  level_.time_s = gun_free_s_ = time_s_;
}

double PlanClock::end_s() const { return std::max(time_s_, landed_s_); }

double mission_time(const GuardProblem& problem, const FiringMap& firing_map, const GuardPlan& plan) {
  PlanClock clock(problem, firing_map, plan);
  while (!clock.done()) clock.make_stop();
  return clock.end_s();
}

Status finish_plan(const GuardProblem& problem, const FiringMap& firing_map, const Budget& budget,
                   GuardPlan& plan) {
  if (auto ok = join(problem, firing_map, budget, plan); !ok) return ok;
  plan.cost_s = mission_time(problem, firing_map, plan);
  return {};
}

}  // namespace outrider
