#include "outrider/jobs/guard/supply_mission.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "outrider/core/overload.hpp"

namespace outrider {
namespace {

constexpr int most_fills = 6;  // between two shots
constexpr double rounding = 1e-9;

/// The charge that a drive takes, and where it ends.
struct Way {
  double charge_j = 0.0;
  double time_s = 0.0;
  Pose2 end;
};

Way way_along(const std::vector<Vec2>& waypoints, double heading_rad, const GuardProblem& problem,
              const Site& site) {
  const DriveCost cost = drive_cost(problem.robot, heading_rad, waypoints, site.ground.terrain());
  return {problem.supplies.charge_of(cost.time_s, cost.driven_m),
          cost.time_s,
          {waypoints.back(), cost.heading_rad}};
}

std::optional<Way> way_to(Vec2 place, const Pose2& from, const SupplyMission& mission,
                          const GuardProblem& problem, const Site& site) {
  if (mission.guard.routes) {
    if (const auto route = mission.guard.routes->route(from, place)) {
      return way_along(route->waypoints, from.heading_rad, problem, site);
    }
  }
  if (const auto routes = site_routes(problem, site, {from.position, place}, {})) {
    if (const auto way = routes->waypoints(0, 1); !way.empty())
      return way_along(way, from.heading_rad, problem, site);
  }
  return std::nullopt;
}

/// Least charge from a pose to a station that gives charge; 0 where there is none to get to.
double charge_home(const Pose2& from, const SupplyMission& mission, const GuardProblem& problem,
                   const Site& site) {
  std::optional<double> least;
  for (const Station& station : problem.supplies.stations) {
    if (!station.gives(Store::charge)) continue;
    const auto way = way_to(station.position, from, mission, problem, site);
    if (way) least = std::min(least.value_or(way->charge_j), way->charge_j);
  }
  return least.value_or(0.0);
}

/// No aim and flight together take longer, s.
double longest_shot_s(const GuardProblem& problem) {
  const double aim = std::max(pi / problem.gun.yaw_rate_radps, pi / problem.gun.pitch_rate_radps);
  return aim + 2.0 * problem.gun.muzzle_speed_mps / problem.world.gravity_mps2;
}

/// The store that does not suffice for a command and what it leads to, if one does not.
std::optional<Store> lacking(const Command& command, const SupplyMission& mission, const Observation& seen,
                             const GuardProblem& problem, const Site& site) {
  const Supplies& supplies = problem.supplies;
  const bool at_station = !mission.guard.errands.empty() && mission.guard.errands.front().call;
  Way way{0.0, 0.0, seen.odometry};
  double shot_j = supplies.charge_of(longest_shot_s(problem), 0.0) + supplies.shot_j;
  const bool known =
      std::visit(Overload{[&](const FollowWaypoints& c) {
                            way = way_along(c.waypoints, seen.odometry.heading_rad, problem, site);
                            return true;
                          },
                          [&](const Fire& c) {
                            const TargetRecord& record = mission.guard.records[c.target];
                            shot_j = supplies.charge_of(record.shot ? record.shot->flight_s : 0.0, 0.0) +
                                     supplies.shot_j;
                            return true;
                          },
                          [&](const AimGun&) { return !at_station; }, [](const auto&) { return false; }},
                 command);
  if (!known) return std::nullopt;
  if (at_station) {
    const Store store = mission.guard.errands.front().call->store;
    const double home = store == Store::charge ? 0.0 : charge_home(way.end, mission, problem, site);
    return seen.stores->charge_j < way.charge_j + home ? std::optional(Store::charge) : std::nullopt;
  }
  if (seen.stores->water < supplies.shot_water - rounding * supplies.tank) return Store::water;
  if (!supplies.ends(Store::charge)) return std::nullopt;
  const double home = charge_home(way.end, mission, problem, site);
  return seen.stores->charge_j < way.charge_j + shot_j + home ? std::optional(Store::charge) : std::nullopt;
}

/// The nearest station that gives the store and that the robot can still get to.
std::optional<std::size_t> nearest_station(Store store, const SupplyMission& mission, const Observation& seen,
                                           const GuardProblem& problem, const Site& site) {
  std::optional<std::size_t> best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t s = 0; s < problem.supplies.stations.size(); ++s) {
    const Station& station = problem.supplies.stations[s];
    if (!station.gives(store)) continue;
    const auto way = way_to(station.position, seen.odometry, mission, problem, site);
    if (!way || way->time_s >= least) continue;
    const double onward = store == Store::charge ? 0.0 : charge_home(way->end, mission, problem, site);
    if (seen.stores->charge_j < way->charge_j + onward) continue;
    least = way->time_s;
    best = s;
  }
  return best;
}

bool is_full(Store store, const Observation& seen, const Supplies& supplies) {
  const double level = store == Store::water ? seen.stores->water : seen.stores->charge_j;
  return level >= (1.0 - rounding) * supplies.full(store);
}

/// What has failed before keeps its reason.
void fail(TargetRecord& record, const std::string& why, double time_s) {
  if (record.status == TargetStatus::failed) return;
  record.status = TargetStatus::failed;
  record.reason = why;
  record.done_s = time_s;
}

void give_up_errand(SupplyMission& mission, Store store, const Observation& seen) {
  GuardMission& guard = mission.guard;
  const std::string why = fmt::format("not even full stores give the {} for it", to_string(store));
  if (!guard.errands.empty()) {
    for (const std::size_t target : guard.errands.front().targets)
      fail(guard.records[target], why, seen.time_s);
    guard.errands.pop_front();
  }
  guard.arrived = false;
  guard.aimed = false;
  mission.fills = 0;
}

void give_up(SupplyMission& mission, Store store, const Observation& seen) {
  GuardMission& guard = mission.guard;
  const std::string why =
      fmt::format("the {} does not suffice, and no station that gives some can be got to", to_string(store));
  for (TargetRecord& record : guard.records) {
    if (record.status == TargetStatus::waiting) fail(record, why, seen.time_s);
  }
  guard.errands.clear();
  guard.second_pass = true;
}

}  // namespace

SupplyMission begin_supplied(const GuardProblem& problem, const GuardPlan& plan) {
  return {begin(problem, plan)};
}

std::optional<Command> step(SupplyMission& mission, const Observation& seen, const GuardProblem& problem,
                            const Site& site) {
  if (!problem.supplies.any()) return step(mission.guard, seen, problem, site);
  hear(mission.guard, seen, problem);
  for (;;) {
    SupplyMission tried = mission;
    const auto command = step(tried.guard, seen, problem, site);
    if (!command) {
      mission = std::move(tried);
      return command;
    }
    const auto store = lacking(*command, tried, seen, problem, site);
    if (!store) {
      if (std::holds_alternative<Fire>(*command)) tried.fills = 0;
      if (std::holds_alternative<Fill>(*command)) ++tried.fills;
      mission = std::move(tried);
      return command;
    }
    if (!std::holds_alternative<Fire>(*command)) mission.guard = std::move(tried.guard);
    mission.guard.arrived = false;
    mission.guard.aimed = false;
    const auto station = nearest_station(*store, mission, seen, problem, site);
    if (!station) {
      give_up(mission, *store, seen);
    } else if (mission.fills >= most_fills || is_full(*store, seen, problem.supplies)) {
      give_up_errand(mission, *store, seen);
    } else {
      ++mission.detours;
      mission.guard.errands.push_front(
          {problem.supplies.stations[*station].position, {}, StationCall{*station, *store}});
    }
  }
}

}  // namespace outrider
