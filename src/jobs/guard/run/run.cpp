#include "outrider/jobs/guard/run/run.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "outrider/log/append.hpp"
#include "run/guard_log.hpp"
#include "team/team_log.hpp"
#include "team/team_report.hpp"

namespace outrider {
namespace {

// Ways may pass obstacles as near as the disk, and rigid wheels are a little off them: the robot of rigid
// bodies is 0.9 times as large, and may find new ways from half of the room between.
constexpr double way_radius = 0.95;

void log_aim(Log& log, double time_s, const MovingTargets& targets, const GuardProblem& problem) {
  const Track& track = targets.tracks()[targets.aimed_at()];
  log_event(
      log, time_s, "lead",
      fmt::format("expects {} at ({:.2f}, {:.2f}), {:.2f} m from where it was seen; a hit is {:.0f} % likely",
                  problem.targets[targets.aimed_at()].name, targets.expected_at().x, targets.expected_at().y,
                  distance(targets.expected_at(), track.back().position), 100.0 * targets.chance()));
}

/// How a failed target was missed by a rigid ball.
void add_misses(TaskBoard& board, const RigidRecord& rigid) {
  for (std::size_t t = 0; t < board.records().size(); ++t) {
    const TargetRecord& record = board.records()[t];
    if (record.status != TargetStatus::failed || rigid.misses[t].empty()) continue;
    board.settle(t, record.status, fmt::format("{}; the last shot {}", record.reason, rigid.misses[t]),
                 record.done_s);
  }
}

/// Marks proofs as open that hold on a map of the robot's own making alone: ground that it could not enter or
/// see counts as an obstacle there, and all obstacles count as high.
void doubt_proofs(TaskBoard& board) {
  for (std::size_t t = 0; t < board.records().size(); ++t) {
    const TargetRecord& record = board.records()[t];
    if (record.status != TargetStatus::unreachable) continue;
    board.settle(t, TargetStatus::failed, "no shot on the ground that was mapped: " + record.reason,
                 record.done_s);
  }
}

/// Notes when intruders come in.
void note_entrances(LogQueue& queue, const GuardRun& run) {
  if (run.mission.arriving() == nullptr) return;
  for (const Intruder& intruder : run.mission.arriving()->plan().yard.intruders) {
    if (intruder.entrance.empty()) continue;
    queue.note_event(intruder.enters_s, "enter",
                     fmt::format("{} comes in by {}", intruder.name, intruder.entrance));
  }
}

/// A mission whose path planner may be without a budget at times, which is a fault to try out.
struct WithOutage {
  GuardMission& mission;
  PlannerOutage outage;
  std::optional<Command> step(const Observation& seen) {
    return mission.step(seen, outage.budget(seen.time_s));
  }
};

/// `robot` logs what it does.
Report simulate(const GuardRun& run, GuardMission mission, SimulatedRobot& robot, Log& log,
                const RunWatch& watch) {
  const SimRecord& record = robot.record;
  TargetLog targets(log, robot.queue(), run);
  note_entrances(robot.queue(), run);
  mission.board().set_stop(watch.stop);
  if (run.truth != nullptr) doubt_proofs(mission.board());
  WithOutage stepped{mission, run.faults.planner};
  double expected_hits = 0.0, now_s = 0.0;
  const bool ended =
      run_mission(stepped, robot, watch.stop, [&](const Observation& seen, const Command* command) {
        now_s = seen.time_s;
        watch.part(settled_part(mission.board().records()));
        if (mission.moving() != nullptr && command != nullptr && std::holds_alternative<AimGun>(*command)) {
          log_aim(log, now_s, *mission.moving(), mission.board().problem());
          expected_hits += mission.moving()->chance();
        }
        targets.note(mission, now_s);
      });
  if (record.rigid) add_misses(mission.board(), *record.rigid);
  targets.finish(mission, now_s);
  if (const std::string& why = mission.stores().stranded(); !why.empty())
    log_event(log, now_s, "stranded", why);
  Report report = judge(run, mission, record, log, now_s, expected_hits);
  if (!ended || watch.stopped()) mark_cancelled(report, log, now_s);
  return report;
}

Outcome<Report> simulate_bodies(const GuardRun& run, Log& log, const RunWatch& watch) {
  const GuardProblem& problem = run.mission.board().problem();
  const FiringMap& firing_map = run.mission.board().firing_map();
  log_yard(log, problem, run.options, run.seed, true);
  auto robot = rigid_guard(problem, firing_map, log, run.seed);
  if (!robot) return pass_on(robot);
  GuardProblem yielding = problem;
  yielding.robot.radius_m *= way_radius;
  Report report = simulate(run, {yielding, firing_map, *run.mission.tour()}, *robot, log, watch);
  robot->log_landed();
  return report;
}

constexpr double longest_walk_s = 7200.0;  // walkers stay at their last place then

Report run_team(const PreparedGuard& guard, Log& log, const RunWatch& watch) {
  const GuardScenario& scenario = guard.scenario;
  const auto& [firing_map, tour, drafts, starts, plan] = *guard.plan;
  const TeamRun team = run_team(scenario.problem, firing_map, *plan,
                                static_cast<std::uint64_t>(scenario.seed), watch, scenario.faults);
  append_team(log, team);
  Report report = judge_team(scenario, firing_map, *plan, team, log);
  if (team.ended_early || watch.stopped()) mark_cancelled(report, log, team.mission_s);
  return report;
}

}  // namespace

Outcome<Report> run_guard(const GuardRun& run, Log& log, const RunWatch& watch) {
  if (run.rigid) return simulate_bodies(run, log, watch);
  log_yard(log, true_problem(run), run.options, run.seed, false);
  SimulatedRobot robot = simulated_guard(
      true_problem(run), run.truth ? run.truth->firing_map : run.mission.board().firing_map(), log, run.seed,
      target_params(run), run.truth ? run.truth->levels : StoreLevels{}, run.faults);
  return simulate(run, run.mission, robot, log, watch);
}

Outcome<Report> run_guard(const PreparedGuard& guard, Log& log, const RunWatch& watch,
                          const TrueYard* truth) {
  if (guard.plan->team) return run_team(guard, log, watch);
  const GuardScenario& scenario = guard.scenario;
  GuardRun run{.mission = *guard.mission,
               .options = scenario.options,
               .seed = static_cast<std::uint64_t>(scenario.seed),
               .survival = {scenario.arrivals.leave, scenario.arrivals.walk_mps},
               .truth = truth,
               .rigid = scenario.sim == "physics",
               .faults = scenario.faults};
  if (guard.walkers) {
    auto walks = draw_walks(scenario.problem, guard.plan->firing_map, scenario.preferences, scenario.wander,
                            run.seed, longest_walk_s, watch.budget());
    if (!walks) return pass_on(walks);
    run.walks = std::move(*walks);
  }
  auto report = run_guard(run, log, watch);
  if (!report || !guard.expected) return report;
  report->metrics.emplace_back("expected_s", guard.expected->mean_s);
  report->metrics.emplace_back("expected_error_s", guard.expected->error_s);
  return report;
}

}  // namespace outrider
