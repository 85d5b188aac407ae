#include "outrider/jobs/pursue/job.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <utility>

#include "outrider/jobs/pursue/report.hpp"
#include "outrider/jobs/pursue/wall_watch.hpp"
#include "outrider/pursuit/optimal.hpp"
#include "summary.hpp"

namespace outrider {
namespace {

double peak_mib() {
  struct rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

/// Returns true if no robot went farther than a cell in a second.
bool is_by_steps(const PursuitState& state) {
  return std::ranges::all_of(state.paths, [](const std::vector<Cell>& path) {
    return std::ranges::adjacent_find(path, [](Cell a, Cell b) {
             return std::abs(a.x - b.x) > 1 || std::abs(a.y - b.y) > 1;
           }) == path.end();
  });
}

/// The bound that somebody who knew the whole future could prove, where the run proved none itself.
void look_back(PursuitRun& run, const PursuitTask& task, const Budget& budget) {
  if (run.faults && run.faults->kidnapped) return;  // it may have been put nearer
  if (!is_by_steps(run.state)) {
    run.lower_bound = 0;
    run.earliest_catch_s = -1;
    return;
  }
  const bool certain = task.rules.known_s >= task.problem.last_s();
  if (certain && !task.rules.ask && run.lower_bound > 0) return;
  run.lower_bound = 0;
  for (const Cell robot : task.robots) {
    PursuitProblem problem = task.problem;
    problem.start = robot;
    Workspace workspace;
    const auto plan = optimal_pursuit(problem, {}, budget, workspace);
    if (!plan) continue;
    run.lower_bound = run.lower_bound == 0 ? plan->lower_bound : std::min(run.lower_bound, plan->lower_bound);
    const int earliest = plan->earliest_catch_s;
    run.earliest_catch_s = run.earliest_catch_s < 0 ? earliest : std::min(run.earliest_catch_s, earliest);
  }
}

/// Returns true for faults that are an answer: the target cannot be caught.
bool is_proven_impossible(const Fault& fault) {
  return fault.code == FaultCode::no_path || fault.code == FaultCode::budget_exhausted;
}

}  // namespace

Outcome<Warnings> PursueJob::load() {
  auto loaded = load_task(scenario);
  if (!loaded) return pass_on(loaded);
  task = std::move(*loaded);
  return Warnings{};
}

Status PursueJob::run(Run& run, const RunWatch& watch) {
  RunSteps steps(watch, 2);
  if (auto ok = steps.next("planning and going"); !ok) return ok;
  const std::string name = std::filesystem::path(scenario.map).filename().string();
  const PursuitProblem& problem = task->problem;
  const auto seed = static_cast<std::uint64_t>(scenario.seed);
  task->rules.budget.stop = watch.stop;
  std::optional<NavigatedPursuer> robot;
  if (scenario.sim == "navigator") {
    auto made = NavigatedPursuer::make(problem, scenario.pursuer, task->rules.known_s, seed);
    if (!made) return pass_on(made);
    robot = std::move(*made);
  }
  PursuitLog log(run.log, problem, name, robot ? scenario.pursuer.robot.radius_m : 0.0);
  if (robot) robot->log_to(run.log, watch.stop);
  WallWatch laps;
  const auto look = [&](const PursuitRun& so_far) { log.note(so_far); };
  auto pursued = robot ? pursue(problem, task->rules, *robot, laps, look)
                       : pursue(problem, task->robots, task->rules, laps, look, scenario.faults, seed);
  constexpr double never = std::numeric_limits<double>::quiet_NaN();
  if (!pursued) {
    if (!is_proven_impossible(pursued.error())) return pass_on(pursued);
    run.report = pursuit_report(pursued.error(), name);
    run.report.machine_times = {
        {"first_feasible_s", never}, {"planning_s", laps.lap_s()}, {"peak_mib", peak_mib()}};
    return {};
  }
  const double first_s = pursued->first_feasible_s < 0.0 ? never : pursued->first_feasible_s;
  const bool stopped = watch.stopped();
  if (!stopped) (void)steps.next("looking back with the whole future known");
  if (!stopped) look_back(*pursued, *task, watch.budget());
  log.note(*pursued);
  run.report = robot ? pursuit_report(problem, *pursued, robot->body(), name)
                     : pursuit_report(problem, *pursued, name);
  run.report.machine_times = {
      {"first_feasible_s", first_s}, {"planning_s", pursued->planning_s}, {"peak_mib", peak_mib()}};
  if (stopped) mark_cancelled(run.report, run.log, static_cast<double>(pursued->state.time_s));
  return {};
}

Job pursue_job() {
  return {.name = "pursue",
          .sentence = "Catch a moving target on a grid of costs, at the least cost.",
          .example = "pursue scenarios/pursuit/park.txt --out out",
          .blank = [] { return std::make_unique<PursueJob>(); },
          .file_option = "map",
          .file_sentence = "map of costs with the robot and the target; may be gzip-compressed",
          .summary = pursuit_summary};
}

}  // namespace outrider
