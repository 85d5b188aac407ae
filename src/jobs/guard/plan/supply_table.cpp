#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "outrider/geometry/polyline.hpp"
#include "outrider/jobs/guard/plan/supply_plan.hpp"

namespace outrider {
namespace {

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
  if (!firing_map.frame.contains(firing_map.frame.cell_at(station.position)))
    return refuse("is outside the yard");
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
  ArrivalOptions few;
  few.stops = static_cast<std::int64_t>(stops);
  SupplyTable table;
  add_stations(supplies, table);
  auto precomputed = precompute_stops(problem, firing_map, plan, few, budget, table.places);
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
