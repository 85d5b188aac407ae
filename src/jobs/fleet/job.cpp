#include "outrider/jobs/fleet/job.hpp"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "fleet_task.hpp"
#include "outrider/core/text.hpp"
#include "outrider/job/clock.hpp"
#include "outrider/job/run_job.hpp"

namespace outrider {

Outcome<Warnings> FleetJob::load() {
  auto loaded = load_fleet(scenario);
  if (!loaded) return pass_on(loaded);
  problem = std::move(*loaded);
  return Warnings{};
}

Status FleetJob::run(Run& run, const RunWatch& watch) {
  if (!problem) return bad_input("the task was not loaded; call load() first");
  RunSteps steps(watch, 1);
  if (auto ok = steps.next("planning"); !ok) return ok;
  const auto chosen = std::ranges::find_if(
      scenario.planners, [&](const auto& planner) { return planner.first.name == scenario.planner; });
  Budget budget = watch.budget();
  if (scenario.budget > 0) budget.expansions = static_cast<std::uint64_t>(scenario.budget);
  const double begin_s = wall_s();
  const auto plan = chosen->second.plan(*problem, budget);
  const double planning_s = wall_s() - begin_s;
  if (plan) {
    if (auto verdict = check(*plan, *problem); !verdict) throw std::logic_error(to_string(verdict.error()));
    run.report = fleet_report(*problem, *plan);
  } else if (plan.error().code == FaultCode::no_path || plan.error().code == FaultCode::budget_exhausted) {
    run.report.status = "not_done";
    run.report.reason = plan.error().sentence;
  } else {
    return pass_on(plan);
  }
  log_fleet(run.log, *problem, scenario, plan ? &*plan : nullptr);
  run.report.world_name = printable(std::filesystem::path(scenario.map).filename().string());
  run.report.settings = settings_of(options());
  run.report.machine_times = {{"planning_s", planning_s}};
  return {};
}

Job fleet_job() {
  return {.name = "fleet",
          .sentence = "Lead several robots over one grid without collisions.",
          .example = "fleet scenarios/fleet/warehouse.map --agents scenarios/fleet/warehouse.scen --out out",
          .blank = [] { return std::make_unique<FleetJob>(); },
          .file_option = "map",
          .file_sentence = "map: map_server YAML, MovingAI .map, PGM or PNG image; may be gzip-compressed",
          .summary = fleet_summary};
}

}  // namespace outrider
