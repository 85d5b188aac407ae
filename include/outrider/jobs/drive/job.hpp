// The job drive: drive to waypoints by the tags in sight, by laser, or by time.
#pragma once

#include <optional>

#include "outrider/job/job.hpp"
#include "outrider/jobs/drive/scenario.hpp"

namespace outrider {

class DriveJob final : public JobTask {
 public:
  DriveJob() : JobTask("drive") {}
  Outcome<Warnings> load() override;
  Status run(Run& run, const RunWatch& watch) override;

  DriveScenario scenario;
  std::optional<DriveSetup> setup;  ///< once loaded

 private:
  [[nodiscard]] Status check_faults() const;

 protected:
  std::vector<OptionGroup> describe() override { return outrider::describe(scenario); }
};

/// Returns its row in the catalogue of jobs.
Job drive_job();

}  // namespace outrider
