// The job `guard`: hit every target in a yard with a ballistic water gun, in the least time.
#pragma once

#include "outrider/job/job.hpp"
#include "outrider/jobs/guard/scenario.hpp"

namespace outrider {

/// A task of the job `guard`.
class GuardJob : public JobTask {
 public:
  GuardJob() : JobTask("guard") {}
  Outcome<Warnings> load() override;
  Status run(Run& run, const RunWatch& watch) override;

  GuardScenario scenario;  ///< options; holds the problem after load()

 protected:
  std::vector<OptionGroup> describe() override { return outrider::describe(scenario); }
};

/// Returns the catalogue entry of the job.
Job guard_job();

}  // namespace outrider
