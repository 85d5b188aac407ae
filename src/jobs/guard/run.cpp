#include "outrider/jobs/guard/run.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "guard_log.hpp"
#include "outrider/jobs/guard/physics_robot.hpp"
#include "outrider/log/append.hpp"

namespace outrider {
namespace {

// Ways may pass obstacles as near as the disk, and rigid wheels are a little off them: the robot of rigid
// bodies is 0.9 times as large, and may find new ways from half of the room between.
constexpr double way_radius = 0.95;

double settled_part(const GuardMission& mission) {
  const auto& records = mission.tasks.records;
  if (records.empty()) return 1.0;
  const auto waiting = std::ranges::count(records, TargetStatus::waiting, &TargetRecord::status);
  return 1.0 - static_cast<double>(waiting) / static_cast<double>(records.size());
}

GuardMission mission_of(const GuardRun& run, const GuardProblem& problem) {
  if (run.walkers) return GuardMission(run.walkers->plan);
  if (run.arrivals) return GuardMission(*run.arrivals);
  return {problem, run.firing_map, run.plan};
}

void log_aim(Log& log, double time_s, const MovingTargets& targets, const GuardProblem& problem) {
  const Track& track = targets.tracks[targets.aimed_at];
  log_event(
      log, time_s, "lead",
      fmt::format("expects {} at ({:.2f}, {:.2f}), {:.2f} m from where it was seen; a hit is {:.0f} % likely",
                  problem.targets[targets.aimed_at].name, targets.expected_at.x, targets.expected_at.y,
                  distance(targets.expected_at, track.back().position), 100.0 * targets.chance));
}

/// How a failed target was missed by a rigid ball.
void add_misses(StopTasks& tasks, const RigidRecord& rigid) {
  for (std::size_t t = 0; t < tasks.records.size(); ++t) {
    TargetRecord& record = tasks.records[t];
    if (record.status != TargetStatus::failed || rigid.misses[t].empty()) continue;
    record.reason += fmt::format("; the last shot {}", rigid.misses[t]);
  }
}

/// What is proven on a map of the robot's own making is not proven in the yard: ground that it could not
/// enter or see counts as an obstacle there, and all obstacles count as high.
void doubt_proofs(StopTasks& tasks) {
  for (TargetRecord& record : tasks.records) {
    if (record.status != TargetStatus::unreachable) continue;
    record.status = TargetStatus::failed;
    record.reason = "no shot on the ground that was mapped: " + record.reason;
  }
}

/// Notes when intruders come in.
void note_entrances(LogQueue& queue, const GuardRun& run) {
  if (!run.arrivals) return;
  for (const Intruder& intruder : run.arrivals->yard.intruders) {
    if (intruder.entrance.empty()) continue;
    queue.note_event(intruder.enters_s, "enter",
                     fmt::format("{} comes in by {}", intruder.name, intruder.entrance));
  }
}

/// `robot` logs what it does; `record` is its record.
Report carry_out(const GuardRun& run, const GuardProblem& known, Robot& robot, const SimRecord& record,
                 TargetLog& targets, Log& log, const RunWatch& watch) {
  GuardMission mission = mission_of(run, known);
  mission.tasks.stop = watch.stop;
  mission.tasks.outage = run.faults.planner;
  if (run.truth) doubt_proofs(mission.tasks);
  double expected_hits = 0.0, now_s = 0.0;
  const bool ended =
      run_mission(mission, robot, watch.stop, [&](const Observation& seen, const Command* command) {
        now_s = seen.time_s;
        watch.part(settled_part(mission));
        if (run.walkers && command != nullptr && std::holds_alternative<AimGun>(*command)) {
          log_aim(log, now_s, mission.moving, run.problem);
          expected_hits += mission.moving.chance;
        }
        targets.note(mission, now_s);
      });
  if (record.rigid) add_misses(mission.tasks, *record.rigid);
  targets.finish(mission, now_s);
  if (mission.stores.stranded) log_event(log, now_s, "stranded", mission.stores.reason);
  Report report = judged(run, mission, record, log, now_s, expected_hits);
  if (!ended || watch.stopped()) mark_cancelled(report, log, now_s);
  return report;
}

}  // namespace

Outcome<Report> run_guard(const GuardRun& run, Log& log, const RunWatch& watch) {
  std::unique_ptr<RigidWorld> bodies;
  if (run.rigid) {
    auto made = make_rigid_world(run.problem);
    if (!made) return pass_on(made);
    bodies = std::move(*made);
  }
  log_yard(log, true_problem(run), run.options, run.seed, run.rigid);
  if (bodies) {
    LogQueue queue;
    TargetLog targets(log, queue, run);
    GuardProblem yielding = run.problem;
    yielding.robot.radius_m *= way_radius;
    PhysicsGuard robot(run.problem, run.firing_map, *bodies, log, run.seed);
    auto report = carry_out(run, yielding, robot, robot.record, targets, log, watch);
    robot.log_landed();
    return report;
  }
  SimulatedRobot robot = simulated_guard(true_problem(run), true_map(run), log, run.seed, target_params(run),
                                         run.truth ? run.truth->levels : StoreLevels{}, run.faults);
  TargetLog targets(log, robot.queue(), run);
  note_entrances(robot.queue(), run);
  return carry_out(run, run.problem, robot, robot.record, targets, log, watch);
}

}  // namespace outrider
