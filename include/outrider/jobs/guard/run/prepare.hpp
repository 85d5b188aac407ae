// prepare_guard(): surveys a yard and plans. A simulated robot (run.hpp), Python and nodes all use what it
// returns.
//
//   auto prepared = prepare_guard(std::move(scenario));
//   if (prepared) run_mission(*(*prepared)->mission, robot, stop, note);
//
// The scenario says whether targets stand still, keep coming, survive hits or walk about, which supplies are
// limited, and how many robots share the targets; the robot senses what GuardMission::step() asks for.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "outrider/job/watch.hpp"
#include "outrider/jobs/guard/capabilities.hpp"
#include "outrider/jobs/guard/mission/mission.hpp"
#include "outrider/jobs/guard/scenario.hpp"
#include "outrider/jobs/guard/team/team_plan.hpp"

namespace outrider {

/// The part of a plan that runs with other seeds and faults share (plan_cache.hpp).
struct YardPlan {
  FiringMap firing_map;
  std::optional<GuardPlan> tour = {};  ///< for targets that stand still; unset for walkers and for a team
  std::vector<TourDraft> drafts = {};  ///< as they were found, the last is `tour`; none if targets come or go
  std::vector<Pose2> starts = {};      ///< of the robots of a team
  std::optional<TeamPlan> team = {};   ///< set for a team
};

/// A mission together with everything that it points at. It is made in place and never moved.
struct PreparedGuard {
  GuardScenario scenario;                     ///< as loaded; `problem` is the yard as the robot knows it
  std::shared_ptr<const YardPlan> plan = {};  ///< always set
  std::optional<ArrivalYard> yard = {};       ///< set if intruders arrive or survive
  std::optional<StopTable> stops = {};        ///< the same
  std::optional<RollingPlan> arrivals = {};   ///< the same
  std::optional<ExpectedTime> expected = {};  ///< set if intruders survive and none arrive
  std::optional<MovingPlan> walkers = {};     ///< set if intruders walk about
  std::optional<GuardMission> mission = {};   ///< of one robot; unset for a team
};

/// Prepares a scenario that load_problem() has read, in two steps, and logs what it finds at `time_s`. The
/// yard is the one in `scenario.problem`, also if it was explored before. Plans are shared through the cache
/// of the watch. Stations are planned where everybody is there from the start and leaves when hit; else the
/// mission goes to them as it must. If nobody comes but some survive, plans make the makespan least, and the
/// expected time is estimated (rolling_plan.hpp). Faults: those of build_firing_map(), the planner,
/// check_supplies(), supply_plan(), find_replan_policy(), find_objective(), precompute_stops(),
/// plan_moving(), starts_of_team() and plan_team().
Outcome<std::unique_ptr<PreparedGuard>> prepare_guard(GuardScenario scenario, RunSteps& steps,
                                                      const RunWatch& watch, Log& log, double time_s = 0.0);

/// Prepares the mission of a robot that is not simulated. Faults: besides, those of check_capabilities() with
/// `own_robot` and those of the caller.
Outcome<std::unique_ptr<PreparedGuard>> prepare_guard(GuardScenario scenario, const RunWatch& watch = {},
                                                      const std::vector<Capability>& of_caller = {});

/// The verdict on a mission.
struct GuardVerdict {
  std::string status;  ///< "done" if every target that can be hit was hit, else "not_done"
  std::string reason;  ///< one sentence; empty if all were hit
};

/// Judges a mission that is over by its records.
GuardVerdict verdict_of(const GuardMission& mission);

}  // namespace outrider
