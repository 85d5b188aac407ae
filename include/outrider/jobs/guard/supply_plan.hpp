// The plan of a guard mission on finite supplies: the plan for supplies without end, with stations.
#pragma once

#include <vector>

#include "outrider/jobs/guard/plan.hpp"
#include "outrider/jobs/guard/precomputed_stops.hpp"

namespace outrider {

/// The decision problem over the stops of an precomputed, with the start first and the stations last.
struct SupplyTable {
  SupplyProblem problem;             ///< its goals are the targets below
  std::vector<std::size_t> targets;  ///< by goal
  std::vector<Vec2> places;          ///< by stop
  std::vector<StationCall> calls;    ///< by station
};

/// Refuses a tank or a battery that is too small for any shot, and a station that the robot cannot get to
/// (bad_input with the key). O(stations) routes; nothing where no store is limited.
Status check_supplies(const GuardProblem& problem, const FiringMap& firing_map);

/// The stations that the robot can get to: of a yard that was explored, those that lie on its map.
std::vector<Station> stations_in_reach(const GuardProblem& problem, const FiringMap& firing_map);

/// Makes the table from the plan for supplies without end, and at most `stops` other places. Where nothing
/// ends there are no stations in it. Refused as check_supplies() and precompute_stops().
Outcome<SupplyTable> supply_table(const GuardProblem& problem, const FiringMap& firing_map,
                                  const GuardPlan& plan, std::size_t stops, const Budget& budget);

/// The plan with the stations that the supplies of the problem call for; `plan` itself where nothing ends.
/// Targets that the supplies do not suffice for are in `unsupplied`, each with a reason. The lower bound of
/// the plan holds for the answer as well. Refused as supply_table().
Outcome<GuardPlan> supply_plan(const GuardProblem& problem, const FiringMap& firing_map, GuardPlan plan,
                               const Budget& budget);

/// Level after each stop of a plan, by its waypoints and shots if nothing goes wrong; without the reserve.
std::vector<SupplyLevel> planned_levels(const GuardProblem& problem, const FiringMap& firing_map,
                                        const GuardPlan& plan);

}  // namespace outrider
