// Plans a guard mission with limited supplies: adds stations to a plan for unlimited supplies.
#pragma once

#include <vector>

#include "outrider/jobs/guard/plan/plan.hpp"
#include "outrider/jobs/guard/plan/stop_table.hpp"

namespace outrider {

/// The decision problem over the precomputed stops. The start is the first stop, the stations are the last.
struct SupplyTable {
  SupplyProblem problem;             ///< its goals are `targets`
  std::vector<std::size_t> targets;  ///< target of each goal
  std::vector<Vec2> places;          ///< position of each stop
  std::vector<StationCall> calls;    ///< station and store of each station stop
};

/// Checks the supplies. Faults: bad_input with the key, for a tank or a battery that is too small for any
/// shot, or a station that the robot cannot reach. Does nothing if no store is limited. O(stations) routes.
Status check_supplies(const GuardProblem& problem, const FiringMap& firing_map);

/// Returns the stations that the robot can reach. In an explored yard, these are the stations on its map.
std::vector<Station> stations_in_reach(const GuardProblem& problem, const FiringMap& firing_map);

/// Makes the table from a plan for unlimited supplies and up to `stops` further stops. It has no stations if
/// no store is limited. Faults: those of check_supplies() and precompute_stops().
Outcome<SupplyTable> supply_table(const GuardProblem& problem, const FiringMap& firing_map,
                                  const GuardPlan& plan, std::size_t stops, const Budget& budget);

/// Returns the plan with the station stops that the limited supplies require; `plan` itself if no store is
/// limited. Else `plan` has to be from rest. Targets for which the supplies do not suffice are in
/// `unsupplied`, each with a reason. With `options.shoot_on_the_move` shots are then moved to drives between
/// the stations (shoot_in_passing()). The lower bounds of `plan` also hold for the result from rest; on the
/// move they are those of mission_bound(). Faults: those of supply_table().
Outcome<GuardPlan> supply_plan(const GuardProblem& problem, const FiringMap& firing_map, GuardPlan plan,
                               const GuardOptions& options, const Budget& budget);

/// Returns true if the water is not below zero, and the charge not below its reserve.
bool suffices(const Supplies& supplies, const SupplyLevel& level);

}  // namespace outrider
