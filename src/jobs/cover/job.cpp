#include "outrider/jobs/cover/job.hpp"

#include <filesystem>
#include <memory>
#include <stdexcept>
#include <utility>

#include "geojson.hpp"
#include "ground/tool_coverage.hpp"
#include "outrider/job/plan_cache.hpp"
#include "outrider/job/run_job.hpp"
#include "outrider/jobs/cover/mission/mission.hpp"
#include "outrider/jobs/cover/report.hpp"
#include "summary.hpp"

namespace outrider {
namespace {

Status cancelled() {
  return fault(FaultCode::cancelled, "it was cancelled while it measured what the drive covers");
}

constexpr double measuring_error = 1e-3;  // of the reach, by chords and rounding

/// Breaks off where a drive without faults does what was proven that it cannot do.
void check_promises(const CoverRun& run) {
  const bool kept = run.drive.time_s >= run.bound.least_s - 1e-6 &&
                    run.drive.time_s <= run.bound.most_s + 1e-6 &&
                    run.driven.fraction >= run.proof.sure_fraction - measuring_error;
  if (!kept) throw std::logic_error("the simulated drive breaks the bounds of its track");
}

/// Drives a track, logs that, and measures what it covers.
struct Driver {
  const CoverTask& task;
  const CoverScenario& scenario;
  std::uint64_t seed;
  RunWatch watch;

  /// Fault: cancelled; those of drive_with_navigator().
  Status drive(CoverRun& run, Log& to, CoverLog& log, const std::stop_token& stop) const {
    return scenario.sim == "navigator" ? drive_navigated(run, to, log, stop) : drive_ideal(run, log, stop);
  }

 private:
  Status drive_ideal(CoverRun& run, CoverLog& log, const std::stop_token& stop) const {
    run.drive =
        drive_track(run.plan.track, *run.plan.ground.ground, task.problem.pace, task.problem.tracking_error_m,
                    seed, watch, [&](const PieceDrive& so_far) { log.note(so_far); });
    if (auto ok = measure(run, run.finished() ? stop : std::stop_token{}); !ok) return ok;
    if (run.finished()) check_promises(run);
    log.note(run.drive);
    log.finish(run.drive, run.driven, {.finished = run.finished()});
    return {};
  }

  Status drive_navigated(CoverRun& run, Log& to, CoverLog& log, const std::stop_token& stop) const {
    auto done = drive_with_navigator(task.problem, task.method, scenario.options, run.plan,
                                     scenario.navigation, scenario.things, seed, to, watch,
                                     [&](const PieceDrive& so_far) { log.note_steered(so_far); });
    if (!done) return pass_on(done);
    run.drive = std::exchange(done->drive, {});
    run.navigated = std::move(*done);
    if (auto ok = measure(run, run.finished() ? stop : std::stop_token{}); !ok) return ok;
    const bool kept = cover_report(task.problem, run, {}).status == "done";
    log.finish(run.drive, run.driven, {run.finished(), kept});
    return {};
  }

  /// Measures the coverage of the drive. That of a stopped drive is measured too: pass a token that never
  /// stops. The measuring of a finished drive can be stopped.
  Status measure(CoverRun& run, const std::stop_token& stop) const {
    run.driven = cover::coverage_of_drive(run.drive, task.problem, run.plan.ground.reach, stop);
    return stop.stop_requested() ? cancelled() : Status{};
  }
};

/// A track with the proof of what it covers.
struct ProvenPlan {
  CoverPlan plan;
  CoverProof proof;
};

/// Plans and proves, or takes both from the cache of the watch under the key.
Outcome<std::shared_ptr<const ProvenPlan>> plan_and_prove(const CoverTask& task, const CoverOptions& options,
                                                          const std::string& key, RunSteps& steps,
                                                          const RunWatch& watch) {
  if (auto ok = steps.next("planning the track"); !ok) return pass_on(ok);
  if (auto planned = find_plan<ProvenPlan>(watch.plans, key); planned) {
    if (auto ok = steps.next("proving what it covers"); !ok) return pass_on(ok);
    return planned;
  }
  auto plan = task.method.plan(task.problem, options, watch.budget());
  if (!plan) return tl::unexpected<Fault>(placed(plan.error(), task));
  if (auto ok = steps.next("proving what it covers"); !ok) return pass_on(ok);
  auto proof = prove(*plan, task.problem, watch.budget());
  if (!proof && proof.error().code == FaultCode::cancelled) return pass_on(proof);
  if (!proof) throw std::logic_error(to_string(proof.error()));
  return keep_plan(watch.plans, key, ProvenPlan{std::move(*plan), std::move(*proof)});
}

/// The options with the method that was chosen.
std::vector<std::pair<std::string, std::string>> settled_settings(const CoverScenario& scenario,
                                                                  const std::string& method) {
  CoverJob settled;
  settled.scenario = scenario;
  settled.scenario.method = method;
  return settings_of(settled.options());
}

/// Adds where the local metres of a moved area are.
void add_frame(Report& report, const AreaFrame& frame) {
  if (!frame.moved()) return;
  report.metrics.emplace_back("origin_x", frame.origin.x);
  report.metrics.emplace_back("origin_y", frame.origin.y);
}

}  // namespace

Outcome<Warnings> CoverJob::load() {
  auto loaded = load_task(scenario);
  if (!loaded) return pass_on(loaded);
  task = std::move(*loaded);
  return task->note.empty() ? Warnings{} : Warnings{task->note};
}

Status CoverJob::run(Run& run, const RunWatch& watch) {
  if (!task) throw std::logic_error("a task is loaded before it runs");
  CoverTask planned_task = *task;
  if (scenario.sim == "navigator") {
    auto inside = kept_inside(task->problem);
    if (!inside) return pass_on(inside);
    planned_task.problem = std::move(*inside);
  }
  const CoverProblem& problem = planned_task.problem;
  RunSteps steps(watch, 3);
  const auto promise = plan_and_prove(planned_task, scenario.options,
                                      plan_key(options(), {"seed", "faults", "things", "laser", "wheels",
                                                           "walk_ins", "navigator", "live_map", "motion"}),
                                      steps, watch);
  if (!promise) return pass_on(promise);
  CoverRun driven{(*promise)->plan, (*promise)->proof, {}, {}, {}, {}};
  const CoverPlan& planned = driven.plan;
  driven.bound = time_bound(planned.track, problem.pace, problem.tracking_error_m, scenario.error_factor);
  if (auto ok = steps.next("driving it"); !ok) return ok;
  const auto seed = static_cast<std::uint64_t>(scenario.seed);
  const std::string name = std::filesystem::path(scenario.area).filename().string();
  CoverLog log(run.log, problem, planned, seed, name);
  if (task->problem.frame.moved()) log_event(run.log, 0.0, "frame", sentence_of(task->problem.frame));
  const Driver driver{*task, scenario, seed, steps.inner()};
  if (auto ok = driver.drive(driven, run.log, log, watch.stop); !ok) return ok;
  run.report = cover_report(problem, driven, name);
  run.report.settings = settled_settings(scenario, planned.method);
  if (!driven.finished()) mark_cancelled(run.report, run.log, driven.drive.time_s);
  add_frame(run.report, task->problem.frame);
  run.files = {{"track.json", cover::track_json(driven, task->problem.frame)},
               {"track.geojson", cover::track_geojson(driven, task->problem.frame)},
               {"areas.geojson", cover::areas_geojson(driven, task->problem.frame)}};
  return {};
}

Job cover_job() {
  return {.name = "cover",
          .sentence = "Pass over every spot of an area, in a guaranteed time.",
          .example = "cover scenarios/cover/room.txt --width 0.2 --out out",
          .blank = [] { return std::make_unique<CoverJob>(); },
          .file_option = "area",
          .file_sentence = "polygon with holes: GeoJSON, GML, YAML or text; or the YAML file of a saved map",
          .summary = cover_summary};
}

}  // namespace outrider
