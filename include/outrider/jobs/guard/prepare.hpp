// prepare_guard(): surveys a yard and plans, so that any robot can carry the mission out.
//
//   auto prepared = prepare_guard(std::move(scenario));
//   if (prepared) run_mission(*(*prepared)->mission, robot, stop, note);
//
// The scenario says whether targets stand still, keep coming, survive hits or walk about, and which supplies
// are limited; the robot senses what GuardMission::step() asks for. Random numbers are drawn as in a
// simulated run of the same scenario.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "outrider/core/budget.hpp"
#include "outrider/jobs/guard/mission.hpp"
#include "outrider/jobs/guard/scenario.hpp"

namespace outrider {

/// A mission together with everything that it points at. It is made in place and never moved.
struct PreparedGuard {
  GuardScenario scenario;                      ///< as loaded
  FiringMap firing_map;                        ///< of the yard
  GuardPlan plan = {};                         ///< for targets that stand still; empty for walkers
  std::optional<ArrivalYard> yard = {};        ///< set if intruders arrive or survive
  std::optional<PrecomputedStops> stops = {};  ///< the same
  std::optional<ArrivalPlan> arrivals = {};    ///< the same
  std::optional<MovingPlan> walkers = {};      ///< set if intruders walk about
  std::optional<GuardMission> mission = {};    ///< always set

  /// Returns the problem with one target for each record of the mission.
  [[nodiscard]] const GuardProblem& problem() const { return yard ? yard->problem : scenario.problem; }
};

/// Prepares the mission of a scenario that load_problem() has read. Faults: bad_input for a yard that has to
/// be explored first, for several robots and for the options of PDDL; those of build_firing_map(), the
/// planner, supply_plan(), arrival_yard(), precompute_stops() and plan_moving().
Outcome<std::unique_ptr<PreparedGuard>> prepare_guard(GuardScenario scenario, const Budget& budget = {});

/// Plans for targets that stand still, with stations if supplies are limited, unless intruders come or
/// survive: then the mission visits stations as it must. `observe` receives tours while they are planned.
/// Faults: those of the planner and of supply_plan().
Outcome<GuardPlan> plan_targets(const GuardScenario& scenario, const GuardProblem& problem,
                                const FiringMap& firing_map, const Budget& budget,
                                const DraftObserver& observe = {});

/// What a mission came to.
struct GuardVerdict {
  std::string status;  ///< "done" if every target that can be hit was hit, else "not_done"
  std::string reason;  ///< one sentence; empty if all were hit
};

/// Judges a mission that is over by its records.
GuardVerdict verdict_of(const GuardMission& mission);

}  // namespace outrider
