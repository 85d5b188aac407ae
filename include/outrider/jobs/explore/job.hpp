// The job explore: map an unknown world to the last reachable cell, then come home.
#pragma once

#include <optional>

#include "outrider/job/job.hpp"
#include "outrider/jobs/explore/scenario.hpp"

namespace outrider {

class ExploreJob final : public JobTask {
 public:
  ExploreJob() : JobTask("explore") {}
  Outcome<Warnings> load() override;
  Status run(Run& run, const RunWatch& watch) override;

  ExploreScenario scenario;
  std::optional<ExploreSetup> setup;  ///< once loaded

 protected:
  std::vector<OptionGroup> describe() override { return outrider::describe(scenario); }
};

/// Returns its row in the catalogue of jobs.
Job explore_job();

}  // namespace outrider
