// The job cover: pass over every spot of an area, in a guaranteed time.
#pragma once

#include <optional>

#include "outrider/job/job.hpp"
#include "outrider/jobs/cover/scenario.hpp"

namespace outrider {

class CoverJob final : public JobTask {
 public:
  CoverJob() : JobTask("cover") {}
  Outcome<Warnings> load() override;
  Status run(Run& run, const RunWatch& watch) override;

  CoverScenario scenario;
  std::optional<CoverTask> task;  ///< once loaded

 protected:
  std::vector<OptionGroup> describe() override { return outrider::describe(scenario); }
};

/// Returns its row in the catalogue of jobs.
Job cover_job();

}  // namespace outrider
