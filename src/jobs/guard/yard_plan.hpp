// What is planned of a yard before a mission begins, and logged.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "outrider/job/watch.hpp"
#include "outrider/jobs/guard/firing_map.hpp"
#include "outrider/jobs/guard/plan.hpp"
#include "outrider/jobs/guard/scenario.hpp"

namespace outrider {

/// What is planned of a yard that is known.
struct YardPlan {
  FiringMap firing_map;
  GuardPlan plan;
  std::vector<TourDraft> drafts;  ///< as they were found, the last is `plan`; none if targets come or go
};

/// Returns the names of options on which the plan of a known yard does not depend (plan_key()): `faults`,
/// which planners do not know, and `seed`, unless it draws intruders, who are planned for.
std::vector<std::string> unplanned_options(const GuardScenario& scenario);

/// Returns the plan of the still yard, with what its capabilities add. Stations are planned where everybody
/// is there from the start and leaves when hit; else the mission goes to them as it must. Walkers need no
/// plan of it. Faults: those of check_supplies() and of the planner.
Outcome<GuardPlan> plan_still_yard(const GuardScenario& scenario, const GuardProblem& problem,
                                   const FiringMap& firing_map, const RunWatch& watch, Log& log,
                                   const DraftObserver& note = {}, double time_s = 0.0);

/// Surveys and plans the yard, or takes both from the cache of the watch under the key. Takes two steps.
/// Faults: those of build_firing_map() and plan_still_yard().
Outcome<std::shared_ptr<const YardPlan>> plan_known_yard(const GuardScenario& scenario,
                                                         const std::string& key, RunSteps& steps,
                                                         const RunWatch& watch, Log& log);

}  // namespace outrider
