#include "outrider/jobs/guard/run/run.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "outrider/job/navigation_log.hpp"
#include "outrider/job/scene.hpp"
#include "outrider/job/sensor_log.hpp"
#include "outrider/log/append.hpp"
#include "run/guard_log.hpp"
#include "team/team_report.hpp"

namespace outrider {
namespace {

// Ways may pass obstacles as near as the disk, and rigid wheels are a little off them: the robot of rigid
// bodies is 0.9 times as large, and may find new ways from half of the room between.
constexpr double way_radius = 0.95;

std::uint64_t seed_of(const PreparedGuard& guard) { return static_cast<std::uint64_t>(guard.scenario.seed); }

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

/// A mission whose path planner may be without a budget at times, which is a fault to try out.
struct WithOutage {
  GuardMission& mission;
  PlannerOutage outage;
  std::optional<Command> step(const Observation& seen) {
    return mission.step(seen, outage.budget(seen.time_s));
  }
};

/// Returns the targets that the simulation lets come, survive or walk.
TargetSimParams target_params(const GuardRun& run) {
  const GuardMission& mission = *run.guard.mission;
  const ArrivalOptions& arrivals = run.guard.scenario.arrivals;
  TargetSimParams params;
  params.survival = {arrivals.leave, arrivals.walk_mps};
  if (const auto* const arriving = mission.arriving()) {
    params.intruders = arriving->plan().yard.intruders;
    params.foreseen = arriving->plan().policy.foresees;
  }
  if (const auto* const moving = mission.moving()) {
    params.walks = run.walks;
    params.look_s = moving->plan().options.look_s;
    params.sight_m = moving->plan().options.sight_m;
  }
  return params;
}

/// Notes when intruders come in.
void note_entrances(LogQueue& queue, const std::vector<Intruder>& intruders) {
  for (const Intruder& intruder : intruders) {
    if (intruder.entrance.empty()) continue;
    queue.note_event(intruder.enters_s, "enter",
                     fmt::format("{} comes in by {}", intruder.name, intruder.entrance));
  }
}

/// `robot` logs what it does.
Report simulate(const GuardRun& run, GuardMission mission, SimulatedRobot& robot, Log& log,
                const RunWatch& watch) {
  const auto* const arriving = mission.arriving();
  TargetLog targets(log, robot.queue(), true_problem(run).targets,
                    arriving != nullptr ? &arriving->plan().yard.intruders : nullptr,
                    mission.moving() != nullptr ? &run.walks : nullptr);
  if (arriving != nullptr) note_entrances(robot.queue(), arriving->plan().yard.intruders);
  mission.board().set_stop(watch.stop);
  if (run.truth != nullptr) doubt_proofs(mission.board());
  WithOutage stepped{mission, run.guard.scenario.faults.planner};
  double now_s = 0.0;
  const bool ended =
      run_mission(stepped, robot, watch.stop, [&](const Observation& seen, const Command* command) {
        now_s = seen.time_s;
        watch.part(settled_part(mission.board().records()));
        if (mission.moving() != nullptr && command != nullptr && std::holds_alternative<AimGun>(*command))
          log_aim(log, now_s, *mission.moving(), mission.board().problem());
        targets.note(mission, now_s);
      });
  if (robot.record.rigid) add_misses(mission.board(), *robot.record.rigid);
  targets.finish(mission, now_s);
  if (const std::string& why = mission.stores().stranded(); !why.empty())
    log_event(log, now_s, "stranded", why);
  Report report = judge(run, mission, robot.record, log, now_s);
  if (!ended || watch.stopped()) mark_cancelled(report, log, now_s);
  return report;
}

Outcome<Report> simulate_bodies(const GuardRun& run, Log& log, const RunWatch& watch) {
  const TaskBoard& board = run.guard.mission->board();
  const GuardProblem& problem = board.problem();
  auto robot = rigid_guard(problem, board.firing_map(), log, seed_of(run.guard));
  if (!robot) return pass_on(robot);
  GuardProblem yielding = problem;
  yielding.robot.radius_m *= way_radius;
  Report report =
      simulate(run, {yielding, board.firing_map(), *run.guard.mission->tour()}, *robot, log, watch);
  robot->log_landed();
  return report;
}

/// Logs what the robot sees on its way. What waits to be logged before that comes first.
NavigatedBody::Look looking(Log& log, LogQueue& queue) {
  return [&log, &queue, navigation = NavigationLog(log)](const Observation& seen, const Situation& now,
                                                         const Navigator& navigator) mutable {
    queue.flush(log, now.time_s);
    navigation.note(seen, now.time_s, navigator.map());
  };
}

Outcome<Report> simulate_navigated(const GuardRun& run, const GuardMission& mission, Log& log,
                                   const RunWatch& watch) {
  const GuardScenario& scenario = run.guard.scenario;
  const auto yard = navigated_yard(true_problem(run), scenario.things);
  if (!yard) return pass_on(yard);
  auto robot = navigated_guard(*yard, mission.board().firing_map(), scenario.navigation, log,
                               seed_of(run.guard), target_params(run),
                               run.truth != nullptr ? run.truth->levels : StoreLevels{}, scenario.faults);
  if (!robot) return pass_on(robot);
  log_solids(log, yard->problem.world, yard->problem.robot.height_m);
  log_mount(log, "laser", scenario.navigation.laser.robot_T_laser, scenario.navigation.laser.height_m);
  robot->body<NavigatedBody>().watch(looking(log, robot->queue()), watch.stop);
  return simulate(run, mission, *robot, log, watch);
}

constexpr double longest_walk_s = 7200.0;  // walkers stay at their last place then

Report run_team(const PreparedGuard& guard, Log& log, const RunWatch& watch) {
  const GuardScenario& scenario = guard.scenario;
  const auto& [firing_map, tour, drafts, starts, plan] = *guard.plan;
  const TeamRun team = run_team(scenario.problem, firing_map, *plan, seed_of(guard), watch, scenario.faults);
  append_team(log, team);
  Report report = judge_team(scenario, firing_map, *plan, team, log);
  if (team.ended_early || watch.stopped()) mark_cancelled(report, log, team.mission_s);
  return report;
}

}  // namespace

Outcome<Report> run_guard(GuardRun run, Log& log, const RunWatch& watch) {
  const PreparedGuard& guard = run.guard;
  if (!guard.mission) return run_team(guard, log, watch);
  const TaskBoard& board = guard.mission->board();
  if (const auto* const moving = guard.mission->moving(); moving != nullptr && run.walks.empty()) {
    auto walks = draw_walks(board.problem(), board.firing_map(), guard.scenario.preferences,
                            moving->plan().options, seed_of(guard), longest_walk_s, watch.budget());
    if (!walks) return pass_on(walks);
    run.walks = std::move(*walks);
  }
  log_yard(log, true_problem(run), guard.scenario);
  if (guard.scenario.sim == "physics") return simulate_bodies(run, log, watch);
  if (guard.scenario.sim == "navigator") return simulate_navigated(run, *guard.mission, log, watch);
  SimulatedRobot robot = simulated_guard(
      true_problem(run), run.truth ? run.truth->firing_map : board.firing_map(), log, seed_of(guard),
      target_params(run), run.truth ? run.truth->levels : StoreLevels{}, guard.scenario.faults);
  Report report = simulate(run, *guard.mission, robot, log, watch);
  if (guard.expected) {
    report.metrics.emplace_back("expected_s", guard.expected->mean_s);
    report.metrics.emplace_back("expected_error_s", guard.expected->error_s);
  }
  return report;
}

}  // namespace outrider
