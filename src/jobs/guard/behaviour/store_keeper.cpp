#include "outrider/jobs/guard/behaviour/store_keeper.hpp"

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

Way way_along(const std::vector<Vec2>& waypoints, double heading_rad, const TaskBoard& board) {
  const GuardProblem& problem = board.problem();
  const DriveCost cost =
      drive_cost(problem.robot, heading_rad, waypoints, board.firing_map().ground.terrain());
  return {problem.supplies.charge_of(cost.time_s, cost.driven_m),
          cost.time_s,
          {waypoints.back(), cost.heading_rad}};
}

std::optional<Way> way_to(Vec2 place, const Pose2& from, const TaskBoard& board) {
  const auto way = yard_way(board.problem(), board.firing_map(), board.routes(), from, place);
  if (!way || way->empty()) return std::nullopt;
  return way_along(*way, from.heading_rad, board);
}

/// Least charge from a pose to a station that gives charge; 0 where there is none to get to.
double charge_home(const Pose2& from, const TaskBoard& board) {
  std::optional<double> least;
  for (const Station& station : board.problem().supplies.stations) {
    if (!station.gives(Store::charge)) continue;
    const auto way = way_to(station.position, from, board);
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
double shots_charge_j(const Command& command, const TaskBoard& board) {
  const GuardProblem& problem = board.problem();
  double time_s = longest_shot_s(problem), shots = 1.0;
  if (const auto* fire = std::get_if<Fire>(&command)) {
    const TargetRecord& record = board.records()[fire->target];
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
std::optional<std::size_t> nearest_station(Store store, const TaskBoard& board, const Observation& seen) {
  const auto& stations = board.problem().supplies.stations;
  std::optional<std::size_t> best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t s = 0; s < stations.size(); ++s) {
    const Station& station = stations[s];
    if (!station.gives(store)) continue;
    const auto way = way_to(station.position, seen.odometry, board);
    if (!way || way->time_s >= least) continue;
    const double onward = store == Store::charge ? 0.0 : charge_home(way->end, board);
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

}  // namespace

std::optional<Store> StoreKeeper::lacking(Command& command, const TaskBoard& board, const Observation& seen) {
  const Supplies& supplies = board.problem().supplies;
  const auto& queue = board.queue();
  const bool at_station = !queue.empty() && queue.front().call;
  if (std::holds_alternative<Fill>(command)) return std::nullopt;
  // All is done but for balls in the air, and nothing else is to come.
  if (std::holds_alternative<Wait>(command) && queue.empty() && !board.more_to_come()) return std::nullopt;
  if (at_station && std::holds_alternative<AimGun>(command)) return std::nullopt;
  const auto* follow = std::get_if<FollowWaypoints>(&command);
  const Way way = follow != nullptr ? way_along(follow->waypoints, seen.odometry.heading_rad, board)
                                    : Way{0.0, 0.0, seen.odometry};
  if (at_station && follow != nullptr) {
    const Store store = queue.front().call->store;
    const double home = store == Store::charge ? 0.0 : charge_home(way.end, board);
    return seen.stores->charge_j < way.charge_j + home ? std::optional(Store::charge) : std::nullopt;
  }
  auto* wait = std::get_if<Wait>(&command);
  if (wait == nullptr && seen.stores->water < supplies.shot_water - rounding * supplies.tank) {
    return Store::water;
  }
  if (!supplies.ends(Store::charge)) return std::nullopt;
  const double home_j = charge_home(way.end, board);
  const double spare_j = seen.stores->charge_j - way.charge_j - shots_charge_j(command, board) - home_j;
  if (wait != nullptr) return lacking_for(*wait, spare_j, seen, supplies);
  return spare_j < 0.0 ? std::optional(Store::charge) : std::nullopt;
}

void StoreKeeper::provide(TaskBoard& board, Store store, const Observation& seen) {
  const Supplies& supplies = board.problem().supplies;
  auto station = nearest_station(store, board, seen);
  if (!station && store == Store::water && !is_full(Store::charge, seen, supplies)) {
    store = Store::charge;  // the way to the water may take more than is left
    station = nearest_station(store, board, seen);
  }
  const bool full = fills_ >= most_fills || is_full(store, seen, supplies);
  if (!station || (full && board.queue().empty())) {
    stranded_ = fmt::format("the {} does not suffice, and no station that gives some can be got to",
                            to_string(store));
    board.fail_waiting(stranded_, seen.time_s);
  } else if (full) {
    // Not even full stores suffice. A target that has failed before keeps its reason.
    for (const std::size_t target : board.drop_task()) {
      if (board.records()[target].status == TargetStatus::failed) continue;
      board.settle(target, TargetStatus::failed,
                   fmt::format("not even full stores give the {} for it", to_string(store)), seen.time_s);
    }
    fills_ = 0;
  } else {
    ++detours_;
    board.do_first({supplies.stations[*station].position, {}, StationCall{*station, store}});
  }
}

void StoreKeeper::note(const Command& command) {
  if (std::holds_alternative<Fill>(command)) ++fills_;
  if (std::holds_alternative<Fire>(command) || std::holds_alternative<Wait>(command)) fills_ = 0;
}

}  // namespace outrider
