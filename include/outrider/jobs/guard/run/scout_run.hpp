// Simulates a mission in an unknown yard: the robot explores the yard, then guards it with the map that it
// made. Both parts are in one log.
//
// While the robot explores, it looks for targets at each scan. It sees a target if the centre of the target
// is within sight and no obstacle hides it in the plane of the range finder. It computes the position of the
// target from its own estimated pose, with a random error, and keeps the mean of all observations. When the
// robot is back at the start, the guard job plans with the map and these targets (scout.hpp), while robot and
// balls move in the true yard.
#pragma once

#include "outrider/job/watch.hpp"
#include "outrider/jobs/explore/run.hpp"
#include "outrider/jobs/guard/run/run.hpp"
#include "outrider/jobs/guard/run/scout.hpp"

namespace outrider {

/// The inputs of exploring.
struct ScoutTask {
  ExploreTask explore;  ///< its start and robot are those of the guard problem
  ExplorerSimParams sensors;
  ScoutOptions options;
};

/// The result of exploring.
struct ScoutedYard {
  ExploreRun run;
  std::vector<std::optional<SeenTarget>> seen;  ///< by target; unset if it was not seen
  FoundYard found;
  std::string failure = {};  ///< why there is nothing to guard on, if so: `found` is not set then
};

/// Explores the yard of `truth`. After a stop request only `run` is set; without a usable map, `found` is
/// not. Faults: those of run_explore().
Outcome<ScoutedYard> scout(const GuardProblem& truth, const ScoutTask& task, std::uint64_t seed, Log& log,
                           const RunWatch& watch = {});

/// Returns the true yard, in which a mission runs that was prepared for `yard.found` (run.hpp), and logs what
/// was seen. The times of the log go on from the end of the exploring. Faults: those of build_firing_map().
Outcome<TrueYard> begin_on_map(const GuardProblem& truth, const ScoutedYard& yard, GuardOptions options,
                               const Budget& budget, Log& log);

/// Adds the exploring to the report of such a mission. The status is "done" if every target was seen and hit,
/// and the robot touched no obstacle. A target without a shot on the map counts as failed, since the map
/// leaves out ground that the robot could not enter. Additional metrics: seen, explored_fraction,
/// map_error_m, explore_s, left_over_m2, contacts. mission_s, driven_m and turned_rad include the exploring.
void add_exploring(Report& report, const GuardProblem& truth, const ScoutedYard& yard, const TrueYard& really,
                   const Log& log);

/// Returns the report of a yard that was explored and then not guarded, for that reason.
Report unguarded(const GuardProblem& truth, const ScoutedYard& yard, const std::string& why);

}  // namespace outrider
