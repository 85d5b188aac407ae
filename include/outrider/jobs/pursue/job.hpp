// The job pursue: catch a moving target on a grid of costs, at the least cost.
#pragma once

#include <optional>

#include "outrider/job/job.hpp"
#include "outrider/jobs/pursue/scenario.hpp"

namespace outrider {

class PursueJob final : public JobTask {
 public:
  PursueJob() : JobTask("pursue") {}
  Outcome<Warnings> load() override;
  Status run(Run& run, const RunWatch& watch) override;

  PursuitScenario scenario;
  std::optional<PursuitTask> task;  ///< once loaded

 protected:
  std::vector<OptionGroup> describe() override { return outrider::describe(scenario); }
};

/// Returns its row in the catalogue of jobs.
Job pursue_job();

}  // namespace outrider
