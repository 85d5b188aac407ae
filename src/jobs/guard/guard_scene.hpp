// What the reports of a guarded yard have in common: the scene, and an entry for each target.
#pragma once

#include "outrider/jobs/guard/guard_mission.hpp"
#include "outrider/report/report.hpp"

namespace outrider {

/// Job, seed, world, robot and start: what is known before anything happens.
void set_the_scene(Report& report, const GuardProblem& problem, const GuardOptions& options,
                   std::uint64_t seed);

/// `report` holds the shots already.
ReportTarget target_entry(const Target& target, const TargetRecord& record, const Report& report);

/// An entry for each target of a still yard, as it is by now; `report` holds the shots already.
void list_targets(Report& report, const GuardProblem& problem, const GuardMission& mission);

/// The stores that end, and the stations that fill them up; no levels yet.
ReportSupplies supplies_entry(const Supplies& supplies);

/// What a robot has written down by the end of a mission.
struct GuardDeeds {
  Report report;  ///< its scene, track, paths, shots and events
  double driven_m = 0.0;
  double turned_rad = 0.0;
};

/// The report of a still yard.
Report guard_report(GuardDeeds deeds, const GuardMission& mission, const GuardProblem& problem,
                    const GuardPlan& plan);

}  // namespace outrider
