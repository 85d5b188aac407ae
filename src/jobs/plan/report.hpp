// The report of an answer.
#pragma once

#include "outrider/jobs/plan/task.hpp"
#include "outrider/report/report.hpp"

namespace outrider {

/// The row of the shortest path, null where none was found. Planners on polygons come first: one on their
/// grid starts and ends at vertices, and may look shorter than the shortest path.
const PlanRow* shortest(const std::vector<const PlanRow*>& rows);

Report plan_report(const PlanTask& task, const PlanQuestion& question, const PlanAnswer& answer);

}  // namespace outrider
