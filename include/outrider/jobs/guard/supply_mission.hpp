// The execution of a guard plan on finite supplies: a guard mission that is not let go on dry or stranded.
//
// The plan's own visits to stations are errands of the guard mission. Before each command of that mission
// this step sees to it that the supplies suffice: for the drive, for one shot at its end, and for the way
// from there to the nearest charger, if there is one. Where they do not, because shots missed or drives went
// astray, the nearest station that the robot can still get to comes first. A target that full stores do not
// suffice for has failed; when no such station is left, all that are still waiting have.
#pragma once

#include <optional>

#include "outrider/jobs/guard/guard_mission.hpp"

namespace outrider {

struct SupplyMission {
  GuardMission guard;
  int fills = 0;    ///< since the last shot
  int detours = 0;  ///< visits to stations that the plan had not
};

SupplyMission begin_supplied(const GuardProblem& problem, const GuardPlan& plan);

/// The next command, or nothing when the mission is over. Where nothing ends it is a guard mission's. Every
/// mission ends: between two shots there are at most six fills.
std::optional<Command> step(SupplyMission& mission, const Observation& seen, const GuardProblem& problem,
                            const Site& site);

}  // namespace outrider
