// What the reports of a guarded yard have in common: the scene, and an entry for each target.
#pragma once

#include "outrider/execute/guard_mission.hpp"
#include "outrider/report/report.hpp"

namespace outrider {

/// World, robot and start.
void set_the_scene(Report& report, const GuardProblem& problem, const GuardOptions& options);

/// `report` holds the shots already.
ReportTarget target_entry(const Target& target, const TargetRecord& record, const Report& report);

}  // namespace outrider
