#include "outrider/jobs/guard/run.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "guard_report.hpp"
#include "outrider/jobs/guard/physics_robot.hpp"

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

void add_aim_event(SimRecord& record, const MovingTargets& targets, const GuardProblem& problem) {
  const Track& track = targets.tracks[targets.aimed_at];
  record.events.push_back(
      {record.end_s(), "lead",
       fmt::format(
           "expects {} at ({:.2f}, {:.2f}), {:.2f} m from where it was seen; a hit is {:.0f} % likely",
           problem.targets[targets.aimed_at].name, targets.expected_at.x, targets.expected_at.y,
           distance(targets.expected_at, track.back().position), 100.0 * targets.chance)});
}

/// How a failed target was missed by a rigid ball.
void add_misses(StopTasks& tasks, const RigidRecord& rigid) {
  for (std::size_t t = 0; t < tasks.records.size(); ++t) {
    TargetRecord& record = tasks.records[t];
    if (record.status != TargetStatus::failed || rigid.misses[t].empty()) continue;
    record.reason += fmt::format("; the last shot {}", rigid.misses[t]);
  }
}

Report carry_out(const GuardRun& run, const GuardProblem& known, Robot& robot, SimRecord& record,
                 const RunWatch& watch) {
  GuardMission mission = mission_of(run, known);
  mission.tasks.stop = watch.stop;
  Report report = opened_report(run);
  double expected_hits = 0.0;
  const auto show = [&] {
    swap_entries(record, report);
    list_targets(report, run, mission, record);
    watch.show(report);
    swap_entries(record, report);
  };
  const bool ended = run_mission(mission, robot, watch.stop, [&](const Observation&, const Command* command) {
    watch.part(settled_part(mission));
    if (watch.wanted()) show();
    if (run.walkers && command != nullptr && std::holds_alternative<AimGun>(*command)) {
      add_aim_event(record, mission.moving, run.problem);
      expected_hits += mission.moving.chance;
    }
  });
  if (watch.observer != nullptr) show();
  if (record.rigid) add_misses(mission.tasks, *record.rigid);
  close_report(report, run, mission, record, expected_hits);
  if (!ended || watch.stopped()) mark_cancelled(report, report.track.back().time_s);
  return report;
}

}  // namespace

Outcome<Report> run_guard(const GuardRun& run, const RunWatch& watch) {
  if (run.rigid) {
    auto bodies = make_rigid_world(run.problem);
    if (!bodies) return pass_on(bodies);
    GuardProblem yielding = run.problem;
    yielding.robot.radius_m *= way_radius;
    PhysicsGuard robot(run.problem, run.firing_map, **bodies, run.seed);
    return carry_out(run, yielding, robot, robot.record, watch);
  }
  SimulatedRobot robot = simulated_guard(true_problem(run), true_map(run), run.seed, target_params(run),
                                         run.truth ? run.truth->levels : StoreLevels{});
  return carry_out(run, run.problem, robot, robot.record, watch);
}

}  // namespace outrider
