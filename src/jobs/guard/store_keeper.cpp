#include "outrider/jobs/guard/store_keeper.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

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
              const FiringMap& firing_map) {
  const DriveCost cost = drive_cost(problem.robot, heading_rad, waypoints, firing_map.ground.terrain());
  return {problem.supplies.charge_of(cost.time_s, cost.driven_m),
          cost.time_s,
          {waypoints.back(), cost.heading_rad}};
}

std::optional<Way> way_to(Vec2 place, const Pose2& from, const StopTasks& tasks, const GuardProblem& problem,
                          const FiringMap& firing_map) {
  if (tasks.routes) {
    if (const auto route = tasks.routes->route(from, place)) {
      return way_along(route->waypoints, from.heading_rad, problem, firing_map);
    }
  }
  if (const auto routes = yard_routes(problem, firing_map, {from.position, place}, {})) {
    if (const auto way = routes->waypoints(0, 1); !way.empty())
      return way_along(way, from.heading_rad, problem, firing_map);
  }
  return std::nullopt;
}

/// Least charge from a pose to a station that gives charge; 0 where there is none to get to.
double charge_home(const Pose2& from, const StopTasks& tasks, const GuardProblem& problem,
                   const FiringMap& firing_map) {
  std::optional<double> least;
  for (const Station& station : problem.supplies.stations) {
    if (!station.gives(Store::charge)) continue;
    const auto way = way_to(station.position, from, tasks, problem, firing_map);
    if (way) least = std::min(least.value_or(way->charge_j), way->charge_j);
  }
  return least.value_or(0.0);
}

/// No aim and flight together take longer, s.
double longest_shot_s(const GuardProblem& problem) {
  const double aim = std::max(pi / problem.gun.yaw_rate_radps, pi / problem.gun.pitch_rate_radps);
  return aim + 2.0 * problem.gun.muzzle_speed_mps / problem.world.gravity_mps2;
}

/// The charge that shots during a drive take, and aim and shot once the robot stands there.
double shots_charge_j(const Command& command, const StopTasks& tasks, const GuardProblem& problem) {
  double time_s = longest_shot_s(problem), shots = 1.0;
  if (const auto* fire = std::get_if<Fire>(&command)) {
    const TargetRecord& record = tasks.records[fire->target];
    time_s = record.shot && fire->until_landed ? record.shot->flight_s : 0.0;
  } else if (const auto* drive = std::get_if<FollowWaypoints>(&command)) {
    shots += static_cast<double>(drive->shots.size());
  }
  return problem.supplies.charge_of(time_s, 0.0) + shots * problem.supplies.shot_j;
}

/// A wait ends while a shot from here and the way to a charger are still possible.
std::optional<Store> lacking_for(Wait& wait, double spare_j, const Observation& seen,
                                 const Supplies& supplies) {
  if (spare_j < 0.0) return Store::charge;
  if (supplies.power_w > 0.0) wait.until_s = std::min(wait.until_s, seen.time_s + spare_j / supplies.power_w);
  return wait.until_s > seen.time_s ? std::nullopt : std::optional(Store::charge);
}

/// The nearest station that gives the store and that the robot can still get to.
std::optional<std::size_t> nearest_station(Store store, const StopTasks& tasks, const Observation& seen,
                                           const GuardProblem& problem, const FiringMap& firing_map) {
  std::optional<std::size_t> best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t s = 0; s < problem.supplies.stations.size(); ++s) {
    const Station& station = problem.supplies.stations[s];
    if (!station.gives(store)) continue;
    const auto way = way_to(station.position, seen.odometry, tasks, problem, firing_map);
    if (!way || way->time_s >= least) continue;
    const double onward = store == Store::charge ? 0.0 : charge_home(way->end, tasks, problem, firing_map);
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
  if (record.status != TargetStatus::failed) settle(record, TargetStatus::failed, why, time_s);
}

/// Not even full stores suffice for the present task.
void give_up_task(StoreKeeper& keeper, StopTasks& tasks, Store store, const Observation& seen) {
  const std::string why = fmt::format("not even full stores give the {} for it", to_string(store));
  for (const std::size_t target : tasks.queue.front().targets) fail(tasks.records[target], why, seen.time_s);
  tasks.queue.pop_front();
  keeper.fills = 0;
}

void give_up(StoreKeeper& keeper, StopTasks& tasks, Store store, const Observation& seen) {
  const std::string why =
      fmt::format("the {} does not suffice, and no station that gives some can be got to", to_string(store));
  for (TargetRecord& record : tasks.records) {
    if (record.status == TargetStatus::waiting) fail(record, why, seen.time_s);
  }
  tasks.queue.clear();
  keeper.stranded = true;
  keeper.reason = why;
}

}  // namespace

std::optional<Store> lacking(Command& command, const StopTasks& tasks, const Observation& seen,
                             const GuardProblem& problem, const FiringMap& firing_map) {
  const Supplies& supplies = problem.supplies;
  const bool at_station = !tasks.queue.empty() && tasks.queue.front().call;
  if (std::holds_alternative<Fill>(command)) return std::nullopt;
  // All is done but for balls in the air, and nothing else is to come.
  if (std::holds_alternative<Wait>(command) && tasks.queue.empty() && !tasks.more_to_come)
    return std::nullopt;
  if (at_station && std::holds_alternative<AimGun>(command)) return std::nullopt;
  const auto* follow = std::get_if<FollowWaypoints>(&command);
  const Way way = follow != nullptr
                      ? way_along(follow->waypoints, seen.odometry.heading_rad, problem, firing_map)
                      : Way{0.0, 0.0, seen.odometry};
  if (at_station && follow != nullptr) {
    const Store store = tasks.queue.front().call->store;
    const double home = store == Store::charge ? 0.0 : charge_home(way.end, tasks, problem, firing_map);
    return seen.stores->charge_j < way.charge_j + home ? std::optional(Store::charge) : std::nullopt;
  }
  auto* wait = std::get_if<Wait>(&command);
  if (wait == nullptr && seen.stores->water < supplies.shot_water - rounding * supplies.tank) {
    return Store::water;
  }
  if (!supplies.ends(Store::charge)) return std::nullopt;
  const double home_j = charge_home(way.end, tasks, problem, firing_map);
  const double spare_j =
      seen.stores->charge_j - way.charge_j - shots_charge_j(command, tasks, problem) - home_j;
  if (wait != nullptr) return lacking_for(*wait, spare_j, seen, supplies);
  return spare_j < 0.0 ? std::optional(Store::charge) : std::nullopt;
}

void provide(StoreKeeper& keeper, StopTasks& tasks, Store store, const Observation& seen,
             const GuardProblem& problem, const FiringMap& firing_map) {
  tasks.arrived = false;
  tasks.aimed = false;
  auto station = nearest_station(store, tasks, seen, problem, firing_map);
  if (!station && store == Store::water && !is_full(Store::charge, seen, problem.supplies)) {
    store = Store::charge;  // the way to the water may take more than is left
    station = nearest_station(store, tasks, seen, problem, firing_map);
  }
  const bool full = keeper.fills >= most_fills || is_full(store, seen, problem.supplies);
  if (!station || (full && tasks.queue.empty())) {
    give_up(keeper, tasks, store, seen);
  } else if (full) {
    give_up_task(keeper, tasks, store, seen);
  } else {
    ++keeper.detours;
    tasks.queue.push_front({problem.supplies.stations[*station].position, {}, StationCall{*station, store}});
  }
}

void note_command(StoreKeeper& keeper, const Command& command) {
  if (std::holds_alternative<Fill>(command)) ++keeper.fills;
  if (std::holds_alternative<Fire>(command) || std::holds_alternative<Wait>(command)) keeper.fills = 0;
}

}  // namespace outrider
