#include "outrider/jobs/guard/watch_run.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "guard_scene.hpp"
#include "outrider/jobs/guard/guard_robot.hpp"
#include "outrider/jobs/guard/watch_bound.hpp"

namespace outrider {
namespace {

constexpr std::size_t missions_played = 40;  // of each manner
constexpr std::int64_t played_beam = 4;      // of their plans, and of those that are carried out

struct Tally {
  double reached = 0.0;
  double failed = 0.0;
  double unreachable = 0.0;
  double inside_s = 0.0;
  double longest_s = 0.0;
  double last_s = 0.0;
};

/// Who was not hit stays until the end, unless it cannot be hit at all.
Tally tally_of(const std::vector<Intruder>& intruders, const std::vector<TargetRecord>& records,
               double end_s) {
  Tally tally;
  for (std::size_t i = 0; i < records.size(); ++i) {
    const TargetStatus status = records[i].status;
    if (status == TargetStatus::unreachable) {
      tally.unreachable += 1.0;
      continue;
    }
    const bool reached = status == TargetStatus::reached;
    (reached ? tally.reached : tally.failed) += 1.0;
    const double leaves_s = reached ? records[i].done_s : end_s;
    tally.inside_s += leaves_s - intruders[i].enters_s;
    tally.longest_s = std::max(tally.longest_s, leaves_s - intruders[i].enters_s);
    tally.last_s = std::max(tally.last_s, leaves_s);
  }
  return tally;
}

void tell_of_arrivals(Report& report, const std::vector<Intruder>& intruders) {
  for (const Intruder& one : intruders) {
    if (one.entrance.empty()) continue;  // it was there from the start
    report.events.push_back(
        {one.enters_s, "enter", fmt::format("{} comes in by {}", one.name, one.entrance)});
  }
  std::stable_sort(report.events.begin(), report.events.end(),
                   [](const ReportEvent& a, const ReportEvent& b) { return a.time_s < b.time_s; });
}

/// The intruders as they ended, where they ended.
std::vector<ReportTarget> entries(const Watch& watch, const GuardMission& mission,
                                  const SimulatedGuard& robot, const Report& report) {
  std::vector<ReportTarget> targets;
  for (std::size_t i = 0; i < watch.intruders.size(); ++i) {
    const Intruder& one = watch.intruders[i];
    Target last = watch.problem.targets[target_of(mission, i)];
    last.name = one.name;
    ReportTarget entry = target_entry(last, mission.records[i], report);
    if (!one.entrance.empty()) entry.visit = ReportVisit{one.entrance, one.from, one.enters_s, one.settles_s};
    if (!robot.moves[i].empty()) entry.moves = robot.moves[i];
    targets.push_back(std::move(entry));
  }
  return targets;
}

}  // namespace

Report run_watch(const WatchPlan& plan, const GuardOptions& options, std::uint64_t seed,
                 const Survival& survival, const RunWatch& watch) {
  const auto& [problem, site, intruders] = plan.watch;
  SimulatedGuard robot(problem, site, seed, intruders, plan.policy.foresees, survival);
  set_the_scene(robot.report, problem, options, seed);
  WatchMission mission = begin(plan);
  const auto show = [&] {
    robot.report.targets = entries(plan.watch, mission.guard, robot, robot.report);
    watch.show(robot.report);
  };
  bool stopped = false;
  while (const auto command = step(mission, robot.sense(), plan)) {
    if (watch.wanted()) show();
    if ((stopped = watch.stopped())) break;
    robot.act(*command);
  }
  if (watch.observer != nullptr) show();

  Report report = std::move(robot.report);
  const double end_s = report.track.back().time_s;
  tell_of_arrivals(report, intruders);
  const auto& records = mission.guard.records;
  report.targets = entries(plan.watch, mission.guard, robot, report);
  const auto targets = static_cast<double>(intruders.size());
  const Tally tally = tally_of(intruders, records, end_s);
  report.status = tally.failed == 0.0 ? "done" : "not_done";
  if (tally.reached < targets) {
    report.reason = fmt::format("{} of {} intruders reached, {} failed, {} out of reach", tally.reached,
                                targets, tally.failed, tally.unreachable);
  }
  const WatchBound bound = watch_bound(plan.watch);
  const bool makespan = plan.objective == WatchObjective::makespan;
  report.metrics = {{"targets", targets},
                    {"reached", tally.reached},
                    {"failed", tally.failed},
                    {"unreachable", tally.unreachable},
                    {"mission_s", end_s},
                    {"intruder_seconds", tally.inside_s},
                    {"makespan_s", tally.last_s},
                    {"longest_s", tally.longest_s},
                    {"lower_bound_s", makespan ? bound.makespan_s : bound.time_inside_s},
                    {"intruder_seconds_bound", bound.time_inside_s},
                    {"makespan_bound_s", bound.makespan_s},
                    {"plans", static_cast<double>(mission.plans)},
                    {"driven_m", robot.driven_m},
                    {"turned_rad", robot.turned_rad},
                    {"shots", static_cast<double>(report.shots.size())}};
  if (survival.leave < 1.0) report.metrics.emplace_back("survived", static_cast<double>(mission.survived));
  if (stopped) mark_cancelled(report, end_s);
  return report;
}

Outcome<Report> keep_watch(const GuardProblem& problem, const Site& site, const GuardPlan& plan,
                           const std::vector<Intruder>& intruders, const ArrivalOptions& arrivals,
                           const GuardOptions& options, std::uint64_t seed, const RunWatch& watch) {
  auto policy = find_watch_policy(arrivals.policy);
  if (!policy) return pass_on(policy);
  auto objective = find_objective(arrivals.objective);
  if (!objective) return pass_on(objective);
  auto yard = watch_over(problem, site, intruders);
  if (!yard) return pass_on(yard);
  auto outlook = look_out(problem, site, plan, arrivals, watch.budget());
  if (!outlook) return pass_on(outlook);
  return run_watch({*yard, *outlook, *policy, *objective, static_cast<std::size_t>(arrivals.group),
                    static_cast<std::size_t>(arrivals.beam)},
                   options, seed, {arrivals.leave, arrivals.walk_mps}, watch);
}

Outcome<Report> wear_down(const GuardProblem& problem, const Site& site, const GuardPlan& plan,
                          const ArrivalOptions& arrivals, const GuardOptions& options, std::uint64_t seed,
                          const RunWatch& watch) {
  auto yard = watch_over(problem, site, settled_intruders(problem));
  if (!yard) return pass_on(yard);
  auto outlook = look_out(problem, site, plan, arrivals, watch.budget());
  if (!outlook) return pass_on(outlook);
  ArrivalOptions quick = arrivals;
  quick.beam = std::min(arrivals.beam, played_beam);
  const auto [manner, expected] = best_manner(problem, *outlook, quick, missions_played, watch.stop);
  if (watch.stopped()) return fault(FaultCode::cancelled, "it was cancelled while it chose how to plan");
  Report report = run_watch({*yard, *outlook, manner.policy, manner.objective,
                             static_cast<std::size_t>(arrivals.group), static_cast<std::size_t>(quick.beam)},
                            options, seed, {arrivals.leave, arrivals.walk_mps}, watch);
  report.metrics.emplace_back("expected_s", expected.mean_s);
  report.metrics.emplace_back("expected_error_s", expected.error_s);
  report.events.insert(
      report.events.begin(),
      {0.0, "plan",
       fmt::format("expects {:.1f} s, to a standard error of {:.1f} s; plans as {}, for the {}",
                   expected.mean_s, expected.error_s, manner.policy.name,
                   manner.objective == WatchObjective::makespan ? "makespan" : "time inside")});
  return report;
}

}  // namespace outrider
