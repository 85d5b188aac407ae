// The job `plan`: find a collision-free path for a disk robot.
#pragma once

#include <optional>

#include "outrider/job/job.hpp"
#include "outrider/jobs/plan/task.hpp"

namespace outrider {

/// A task of the job `plan`.
///
/// run() returns a table "rows" (answer.hpp), a table "speed_profile" of the fastest drive along the shortest
/// path, a report with paths and metrics, and pictures. If a single query has no path, the status is
/// "not_done". If the robot cannot stand at its start or goal, that is a fault: outside_map, start_blocked or
/// goal_blocked. If there are several rows, each has its own status. The metrics are those of the shortest
/// path found.
///
/// Trap: the defaults of "radius", "planner", "model" and "resolution" depend on the map. If you set one of
/// these in `scenario` directly and not through run_job.hpp, add its key to `given`.
class PlanJob final : public JobTask {
 public:
  PlanJob() : JobTask("plan") {}
  Outcome<Warnings> load() override;
  Status run(Run& run, const RunWatch& watch) override;

  PlanScenario scenario;
  std::optional<PlanTask> task;  ///< set by load()

 protected:
  std::vector<OptionGroup> describe() override { return outrider::describe(scenario); }
};

/// Returns the catalogue entry of the job.
Job plan_job();

}  // namespace outrider
