// A mission in a yard that is not known, simulated: explore it, then guard it on the map found, in one
// report.
//
// While the robot explores, each scan goes with a look around: a target is seen when its centre is within
// sight and nothing stands before it in the plane of the range finder. The robot puts it where it takes
// itself to be, with the error of a look, and remembers the mean of all looks. Once it is home again, survey,
// planner and executor of the guard job work on the map found and on the targets remembered
// (guard/scout.hpp), while robot and balls move in the true yard.
#pragma once

#include "outrider/job/watch.hpp"
#include "outrider/jobs/explore/run.hpp"
#include "outrider/jobs/guard/plan.hpp"
#include "outrider/jobs/guard/scout.hpp"

namespace outrider {

struct ScoutTask {
  ExploreTask explore;  ///< its start and robot are those of the guard problem
  ExplorerSimParams sensors;
  ScoutOptions options;
};

/// What exploring found.
struct ScoutedYard {
  ExploreRun run;
  std::vector<std::optional<SeenTarget>> seen;  ///< by target
  FoundYard found;
};

/// Explores the yard of `truth`. Of one that was stopped only `run` is there. Faults: those of run_explore()
/// and found_yard(), and no_path when the robot does not know any more where it is.
Outcome<ScoutedYard> scout(const GuardProblem& truth, const ScoutTask& task, std::uint64_t seed,
                           const RunWatch& watch = {});

/// Carries out a plan that was made for yard.found on `firing_map`, the survey of it, in the true yard. The
/// report begins with the exploring; the times of the guarding go on from there. status is "done" when every
/// target was seen, every one that can be hit was, and the robot touched nothing. Metrics, beside those of
/// run_guard(): seen, explored_fraction, map_error_m, explore_s, contacts; mission_s, driven_m and
/// turned_rad are of the whole. Faults:
/// those of build_firing_map(), for the true yard. The observer sees the whole, the exploring first.
Outcome<Report> run_guard_on_map(const GuardProblem& truth, ScoutedYard yard, const FiringMap& firing_map,
                                 const GuardPlan& plan, const GuardOptions& options, std::uint64_t seed,
                                 const RunWatch& watch = {});

}  // namespace outrider
