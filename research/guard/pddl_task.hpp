// A task of the job guard that writes its decision problem as PDDL, or judges a plan for it, instead of a
// mission.
#pragma once

#include "outrider/job/job.hpp"
#include "outrider/jobs/guard/scenario.hpp"

namespace outrider {

/// Options to export the decision problem as PDDL 2.1, or to validate a PDDL plan, instead of running a
/// mission.
struct PddlOptions {
  bool write = false;         ///< write domain, problem and Outrider's own plan
  std::int64_t stops = 8;     ///< number of stops to offer in addition to those of the plan
  std::string validate;       ///< path of a plan to validate; empty: none
  double tolerance_s = 1e-3;  ///< allowed error of times in that plan

  [[nodiscard]] bool any() const { return write || !validate.empty(); }
};
std::vector<Option> describe(PddlOptions& options);

/// Writes domain.pddl, problem.pddl and our plan.txt, or judges the plan that the scenario names. Metrics:
/// stops, poses, targets, makespan_s of our plan, lower_bound_s and whether that is proven; of a judged plan
/// actions, makespan_s and our_makespan_s. A plan that is not valid is not done, and the reason says where it
/// breaks.
Status run_pddl(const GuardScenario& scenario, const PddlOptions& pddl, Run& run, const RunWatch& watch);

/// Returns the row of guard with the section `pddl`, in place of that of the library.
Job guard_job_with_pddl();

}  // namespace outrider
