#include "outrider/jobs/guard/plan/supply_plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "outrider/geometry/polyline.hpp"
#include "outrider/jobs/guard/plan/bound.hpp"
#include "outrider/jobs/guard/plan/plan.hpp"
#include "plan/plan_clock.hpp"

namespace outrider {
namespace {

constexpr std::size_t other_stops = 60;

/// Returns true if a robot that does nothing else can serve the goal.
bool is_possible_alone(SupplyProblem problem, std::uint32_t goal, const Budget& budget) {
  problem.table.services = services_of(problem.table, {goal});
  problem.table.goals = 1;
  const auto tour = solve_supplied(problem, {.iterations = 0}, budget);
  return tour && tour->dropped.empty();
}

std::string why_unsupplied(const Supplies& supplies, const SupplyProblem& problem, std::uint32_t goal,
                           const Budget& budget) {
  const auto fills = [&](Store store) {
    return std::ranges::count(problem.stations, store, &TourStation::store) > 0;
  };
  if (!is_possible_alone(problem, goal, budget)) {
    return fmt::format(
        "a battery of {:g} Wh, {:.0f} % of it in reserve, does not suffice to get to a place with a "
        "shot at it{}",
        supplies.battery_wh, 100.0 * supplies.reserve, fills(Store::charge) ? " and back to a charger" : "");
  }
  const bool dry = supplies.ends(Store::water) && !fills(Store::water);
  const bool flat = supplies.ends(Store::charge) && !fills(Store::charge);
  if (dry && !flat)
    return fmt::format("a tank of {:g} is empty before, and no station gives water", supplies.tank);
  if (flat && !dry) {
    return fmt::format("a battery of {:g} Wh is empty before, and no station gives charge",
                       supplies.battery_wh);
  }
  return dry ? "the supplies end before, and no station fills them up"
             : "no order was found in which the supplies suffice";
}

/// Stops with the shots solved again, for the pitch at which the shot before leaves the barrel.
std::vector<PlannedStop> stops_of(const GuardProblem& problem, const FiringMap& firing_map,
                                  const SupplyTable& table, const SupplyTour& tour, const GuardPlan& plan) {
  std::vector<PlannedStop> stops;
  double pitch = 0.0;
  for (const SupplyStep& step : tour.steps) {
    PlannedStop stop;
    stop.position = table.places[step.stop];
    if (step.station) {
      stop.call = table.calls[*step.station];
      pitch = 0.0;
    }
    for (const std::uint32_t goal : step.goals) {
      const std::size_t target = table.targets[goal];
      auto shot = shot_from(problem, firing_map, target, stop.position, pitch);
      if (!shot) {  // the one that the plan had from there
        for (const PlannedStop& before : plan.stops) {
          for (const PlannedHit& hit : before.hits) {
            if (hit.target == target) shot = hit.shot;
          }
        }
      }
      stop.hits.push_back({target, *shot});
      pitch = shot->gun.pitch_rad;
    }
    stops.push_back(std::move(stop));
  }
  return stops;
}

/// The plan with shots in passing. Its bound is that of missions with unlimited supplies.
GuardPlan on_the_move(const GuardProblem& problem, const FiringMap& firing_map, const GuardPlan& plan,
                      const GuardOptions& options, const Budget& budget) {
  GuardPlan result = shoot_in_passing(problem, firing_map, plan, budget.stop);
  if (!plan.unsupplied.empty()) return result;
  result.lower_bound_s = result.anywhere_lower_bound_s =
      mission_bound(problem, firing_map, plan.targets(), options, budget);
  return result;
}

/// Returns the first fault that does not depend on the yard, or success.
Status check_amounts(const Supplies& supplies) {
  if (supplies.tank > 0.0 && supplies.shot_water > supplies.tank) {
    return bad_input(
        fmt::format("a tank of {:g} is too small for any shot, which takes {:g}; give more, or less "
                    "supplies.shot_water",
                    supplies.tank, supplies.shot_water),
        "supplies.tank");
  }
  const double usable = (1.0 - supplies.reserve) * supplies.full(Store::charge);
  if (supplies.battery_wh > 0.0 && supplies.shot_j > usable) {
    return bad_input(
        fmt::format("a battery of {:g} Wh gives {:.0f} J beside its reserve, too little for any shot, "
                    "which takes {:g} J; give more, or less supplies.shot",
                    supplies.battery_wh, usable, supplies.shot_j),
        "supplies.battery");
  }
  return {};
}

/// Each station must be where the robot can stand, and must be joined to the start.
Status check_station(const GuardProblem& problem, const FiringMap& firing_map, const Station& station) {
  const auto refuse = [&](std::string_view why) {
    return bad_input(
        fmt::format("station {} at ({:g}, {:g}) {}; move it to free ground that can be driven to",
                    station.name, station.position.x, station.position.y, why),
        "supplies.stations");
  };
  if (!firing_map.cell_of(station.position)) return refuse("is outside the yard");
  if (!firing_map.ground.segment_free({station.position, station.position}, problem.robot.radius_m)) {
    return refuse("is too close to an obstacle for the robot");
  }
  const auto routes = yard_routes(problem, firing_map, {problem.start.position, station.position}, {});
  if (!routes || !std::isfinite(routes->between(0, 1).time_s))
    return refuse("is out of reach from the start");
  return {};
}

/// One station for each store that a station gives and that ends; its place is a number among them.
void add_stations(const Supplies& supplies, SupplyTable& table) {
  for (std::size_t s = 0; s < supplies.stations.size(); ++s) {
    for (const Store store : {Store::water, Store::charge}) {
      if (!supplies.ends(store) || !supplies.stations[s].gives(store)) continue;
      const double per_unit = supplies.filling_s(store, 1.0) - supplies.filling_s(store, 0.0);
      table.problem.stations.push_back(
          {table.places.size(), store, supplies.filling_s(store, 0.0), per_unit});
      table.calls.push_back({s, store});
      table.places.push_back(supplies.stations[s].position);
    }
  }
}

}  // namespace

Outcome<GuardPlan> supply_plan(const GuardProblem& problem, const FiringMap& firing_map, GuardPlan plan,
                               const GuardOptions& options, const Budget& budget) {
  if (!problem.supplies.any()) return plan;
  auto table = supply_table(problem, firing_map, plan, other_stops, budget);
  if (!table) return pass_on(table);
  if (table->targets.empty()) return plan;
  auto tour = solve_supplied(table->problem, {}, budget);
  if (!tour) return pass_on(tour);
  plan.stops = stops_of(problem, firing_map, *table, *tour, plan);
  for (const std::uint32_t goal : tour->dropped) {
    plan.unsupplied.push_back(
        {table->targets[goal], why_unsupplied(problem.supplies, table->problem, goal, budget)});
  }
  plan.tour_proven = tour->proven_optimal;
  if (!plan.unsupplied.empty())
    plan.lower_bound_s = plan.anywhere_lower_bound_s = 0.0;  // for hitting them all
  if (auto ok = finish_plan(problem, firing_map, budget, plan); !ok) return pass_on(ok);
  plan.expected_s.reset();
  plan.lower_bound_s = std::min(plan.lower_bound_s, plan.cost_s);
  return options.shoot_on_the_move ? on_the_move(problem, firing_map, plan, options, budget) : plan;
}

bool suffices(const Supplies& supplies, const SupplyLevel& level) {
  constexpr double rounding = 1e-9;
  const double spare = supplies.ends(Store::charge) ? supplies.reserve * supplies.full(Store::charge) : 0.0;
  return level.water >= -rounding && level.charge >= spare - rounding;
}

Status check_supplies(const GuardProblem& problem, const FiringMap& firing_map) {
  if (!problem.supplies.any()) return {};
  if (auto ok = check_amounts(problem.supplies); !ok) return ok;
  for (const Station& station : problem.supplies.stations) {
    if (auto ok = check_station(problem, firing_map, station); !ok) return ok;
  }
  return {};
}

std::vector<Station> stations_in_reach(const GuardProblem& problem, const FiringMap& firing_map) {
  std::vector<Station> stations = problem.supplies.stations;
  std::erase_if(stations,
                [&](const Station& station) { return !check_station(problem, firing_map, station); });
  return stations;
}

Outcome<SupplyTable> supply_table(const GuardProblem& problem, const FiringMap& firing_map,
                                  const GuardPlan& plan, std::size_t stops, const Budget& budget) {
  if (auto ok = check_supplies(problem, firing_map); !ok) return pass_on(ok);
  const Supplies& supplies = problem.supplies;
  SupplyTable table;
  add_stations(supplies, table);
  auto precomputed = precompute_stops(problem, firing_map, plan, stops, budget, table.places);
  if (!precomputed) return pass_on(precomputed);

  const std::size_t stations_from = precomputed->stops.size() - table.places.size();
  for (auto& station : table.problem.stations) station.stop += stations_from;
  table.places = precomputed->stops;
  for (std::size_t t = 0; t < precomputed->reachable.size(); ++t) {
    if (precomputed->reachable[t] != 0) table.targets.push_back(t);
  }
  table.problem.table = std::move(precomputed->table);
  table.problem.table.services = services_of(table.problem.table, table.targets);
  table.problem.table.goals = table.targets.size();
  for (std::size_t i = 0; i < table.places.size(); ++i) {
    for (std::size_t j = 0; j < table.places.size(); ++j) {
      table.problem.lengths_m.push_back(length_of(precomputed->routes.waypoints(i, j)));
    }
  }
  table.problem.water = supplies.full(Store::water);
  table.problem.charge = (1.0 - supplies.reserve) * supplies.full(Store::charge);
  table.problem.water_per_shot = supplies.shot_water;
  table.problem.charge_per_metre = supplies.drive_jpm;
  table.problem.charge_per_second = supplies.power_w;
  table.problem.charge_per_shot = supplies.shot_j;
  return table;
}

}  // namespace outrider
