// The job guard: hit every target in a yard with a ballistic water gun, soonest.
#pragma once

#include "outrider/job/job.hpp"
#include "outrider/jobs/guard/scenario.hpp"

namespace outrider {

class GuardJob final : public JobTask {
 public:
  GuardJob() : JobTask("guard") {}
  Outcome<Warnings> load() override;
  Outcome<Run> run(const RunWatch& watch) override;

  GuardScenario scenario;  ///< with the problem, once loaded

 protected:
  std::vector<OptionGroup> describe() override { return outrider::describe(scenario); }
};

/// Its row in the catalogue.
Job guard_job();

}  // namespace outrider
