// The job plan: find a collision-free path for a disk robot.
#pragma once

#include <optional>

#include "outrider/job/job.hpp"
#include "outrider/jobs/plan/task.hpp"

namespace outrider {

/// Options that are set here and not through run_job.hpp belong into `given` as well, where their default
/// depends on the map: "radius", "planner", "model", "resolution".
///
/// run() answers with a table "rows" (answer.hpp), paths and metrics in the report, and pictures. That a
/// single query has no path is an answer, status "not_done"; that the robot cannot stand at its ends is a
/// fault: outside_map, start_blocked, goal_blocked. Of several rows each has its own status. Metrics are
/// those of the shortest path that was found.
class PlanJob final : public JobTask {
 public:
  PlanJob() : JobTask("plan") {}
  Outcome<Warnings> load() override;
  Outcome<Run> run(const RunWatch& watch) override;

  PlanScenario scenario;
  std::optional<PlanTask> task;  ///< once loaded

 protected:
  std::vector<OptionGroup> describe() override { return outrider::describe(scenario); }
};

/// Its row in the catalogue.
Job plan_job();

}  // namespace outrider
