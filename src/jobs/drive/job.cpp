#include "outrider/jobs/drive/job.hpp"

#include "outrider/jobs/drive/run.hpp"
#include "summary.hpp"

namespace outrider {

/// Refuses keys that say what goes wrong where nothing of it is simulated.
Status DriveJob::check_faults() const {
  if (scenario.loop != "laser") return {};
  for (const std::string& key : given) {
    if (key.starts_with("faults.") || key.starts_with("link."))
      return bad_input("a drive by laser has no such faults; leave it out, or give loop: closed", key);
  }
  return {};
}

Outcome<Warnings> DriveJob::load() {
  if (auto ok = check_faults(); !ok) return pass_on(ok);
  auto loaded = load_drive(scenario);
  if (!loaded) return pass_on(loaded);
  setup = std::move(*loaded);
  return std::exchange(setup->warnings, {});
}

Status DriveJob::run(Run& run, const RunWatch& watch) {
  RunSteps steps(watch, 1);
  if (auto ok = steps.next("driving"); !ok) return ok;
  if (scenario.loop == "laser") {
    LaserDriveOptions options = scenario.laser;
    options.rendered = setup->rendered;
    options.hung = setup->sim.tags;
    auto report = run_laser_drive(setup->task, scenario.height_m, options,
                                  static_cast<std::uint64_t>(scenario.seed), run.log, steps.inner());
    if (!report) return pass_on(report);
    run.report = std::move(*report);
    return {};
  }
  run.report = run_drive(setup->task, setup->sim, setup->rendered, static_cast<std::uint64_t>(scenario.seed),
                         run.log, steps.inner());
  if (setup->plan) {
    run.report.metrics.emplace_back("path_m", length_of(*setup->plan));
    run.report.metrics.emplace_back("path_clearance_m", setup->path_clearance_m);
  }
  return {};
}

Job drive_job() {
  return {.name = "drive",
          .sentence = "Drive to waypoints by tags, by laser around what stands in the way, or by time.",
          .example = "drive --scenario scenarios/waypoints/closed_loop.yaml --loop open",
          .blank = [] { return std::make_unique<DriveJob>(); },
          .summary = drive_summary};
}

}  // namespace outrider
