#include "flying_balls.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "lost_targets.hpp"

namespace outrider {
namespace {

constexpr double lost_s = 5.0;  // after the planned landing, a ball without a result

/// Takes a target off the stops that were to hit it.
void take_off(StopTasks& tasks, std::size_t target) {
  for (StopTask& task : tasks.queue) {
    const auto at = std::ranges::find(task.targets, target);
    if (at == task.targets.end()) continue;
    const auto k = at - task.targets.begin();
    task.targets.erase(at);
    if (std::cmp_less(k, task.guns.size())) task.guns.erase(task.guns.begin() + k);
  }
}

bool has_stop(const StopTasks& tasks, std::size_t record) {
  return std::ranges::any_of(tasks.queue, [record](const StopTask& task) {
    return std::ranges::find(task.targets, record) != task.targets.end();
  });
}

/// The records that may be hit during the drive to the present task: first those that are to be, then those
/// by the way; no two at the same place. Drives to stations are for the store alone.
std::vector<std::size_t> wanted_in_passing(StopTasks& tasks) {
  const StopTask& task = tasks.queue.front();
  std::vector<std::size_t> wanted = task.passing;
  std::erase_if(tasks.lost, [&](std::size_t record) { return !has_stop(tasks, record); });
  if (!tasks.on_the_move || task.call) return wanted;
  for (const auto* records : {&tasks.by_the_way, &tasks.lost}) {
    for (const std::size_t record : *records) {
      const auto stands_there = [&](std::size_t other) {
        return target_of(tasks, other) == target_of(tasks, record);
      };
      if (std::ranges::none_of(wanted, stands_there)) wanted.push_back(record);
    }
  }
  return wanted;
}

/// The shots at all targets, if those at the first `planned` of them do not suffer from it; else these alone.
std::vector<PassingHit> hits_along(PassingShots& solver, const Observation& seen,
                                   const std::vector<Vec2>& way, const std::vector<std::size_t>& targets,
                                   std::size_t planned) {
  const double heading = seen.odometry.heading_rad;
  const GunState gun = seen.gun.value_or(GunState{});
  const std::vector<std::size_t> first(targets.begin(),
                                       targets.begin() + static_cast<std::ptrdiff_t>(planned));
  auto needed = solver.along(heading, way, gun, first);
  if (planned == targets.size()) return needed;
  auto all = solver.along(heading, way, gun, targets);
  const bool suffers = std::ranges::any_of(needed, [&](const PassingHit& hit) {
    return std::ranges::find(all, hit.target, &PassingHit::target) == all.end();
  });
  return suffers ? needed : all;
}

/// The number of shots for which there is water.
std::size_t shots_left(const Observation& seen, const GuardProblem& problem) {
  constexpr double rounding = 1e-9, many = 1e6;
  if (!seen.stores || !problem.supplies.ends(Store::water)) return static_cast<std::size_t>(many);
  const double shots = (1.0 + rounding) * seen.stores->water / problem.supplies.shot_water;
  return static_cast<std::size_t>(std::clamp(shots, 0.0, many));
}

/// The first records of those with these targets that no shot hits.
std::vector<std::size_t> not_hit_of(const std::vector<std::size_t>& records,
                                    const std::vector<std::size_t>& targets,
                                    const std::vector<PassingHit>& hits) {
  std::vector<std::size_t> left;
  for (std::size_t i = 0; i < records.size(); ++i) {
    if (std::ranges::find(hits, targets[i], &PassingHit::target) == hits.end()) left.push_back(records[i]);
  }
  return left;
}

/// Notes that a shot will be fired in passing.
void note_shot(StopTasks& tasks, std::size_t target, const PassingHit& hit, const std::vector<Vec2>& way,
               const Observation& seen, const GuardProblem& problem, const FiringMap& firing_map) {
  const Vec2 from = way[hit.leg - 1];
  const Vec2 to = way[hit.leg];
  TargetRecord& record = tasks.records[target];
  ++record.shots;
  record.shot = hit.shot;
  record.pose = {platform_on(problem.robot, from, to, hit.after_s, firing_map.ground.terrain()).position,
                 heading_of(to - from)};
  const double leaves_s = seen.time_s + hit.leaves_s;
  tasks.flying.push_back({target, leaves_s + hit.shot.flight_s, true, leaves_s});
}

}  // namespace

std::string missed(const TargetRecord& record) {
  if (record.unanswered > 0) {
    return fmt::format(
        "no hit by {} shot{}, of which {} had no result: is the gun jammed, or its tank empty?", record.shots,
        record.shots == 1 ? "" : "s", record.unanswered);
  }
  return fmt::format("missed {} time{}", record.shots, record.shots == 1 ? "" : "s");
}

std::optional<std::vector<FireInPassing>> shots_in_passing(StopTasks& tasks, const std::vector<Vec2>& way,
                                                           const Observation& seen,
                                                           const GuardProblem& problem,
                                                           const FiringMap& firing_map) {
  const std::vector<std::size_t> wanted = wanted_in_passing(tasks);
  std::vector<FireInPassing> shots;
  if (wanted.empty()) return shots;
  auto planned = tasks.queue.front().passing;
  std::vector<std::size_t> targets;
  for (const std::size_t record : wanted) targets.push_back(target_of(tasks, record));
  PassingShots solver(problem, firing_map);
  auto hits = hits_along(solver, seen, way, targets, planned.size());
  hits.resize(std::min(hits.size(), shots_left(seen, problem)));
  if (stops_first(tasks, not_hit_of(planned, targets, hits), seen, problem, firing_map)) return std::nullopt;
  tasks.queue.front().passing.clear();
  for (const PassingHit& hit : hits) {
    const auto nth = std::ranges::find(targets, hit.target) - targets.begin();
    const std::size_t record = wanted[static_cast<std::size_t>(nth)];
    note_shot(tasks, record, hit, way, seen, problem, firing_map);
    shots.push_back({record, hit.leg, hit.after_s, hit.shot.shot});
    take_off(tasks, record);
    std::erase(planned, record);
  }
  for (const std::size_t record : planned) {
    stop_for(tasks, record, problem, firing_map);
    tasks.lost.push_back(record);
  }
  return shots;
}

void note_flying(StopTasks& tasks, const Observation& seen, const GuardProblem& problem,
                 const FiringMap& firing_map) {
  for (const FlyingBall& ball : std::exchange(tasks.flying, {})) {
    TargetRecord& record = tasks.records[ball.target];
    const ShotResult* const result = result_of(seen, ball.target);
    if (result == nullptr && seen.time_s < ball.lands_s + lost_s) {
      tasks.flying.push_back(ball);
      continue;
    }
    if (result == nullptr && ball.unsure) {
      --record.shots;
      stop_for(tasks, ball.target, problem, firing_map);
      continue;
    }
    if (result == nullptr) ++record.unanswered;
    tasks.silence.note(ball.target, result != nullptr, seen.time_s);
    if (result != nullptr && result->hit) {
      settle(
          record, TargetStatus::reached,
          fmt::format("hit by shot {}{} from ({:.2f}, {:.2f})", record.shots,
                      ball.in_passing ? " in passing" : "", record.pose.position.x, record.pose.position.y),
          result->landed_s);
    } else if (++record.tries < problem.tries) {
      stop_for(tasks, ball.target, problem, firing_map);
    } else {
      settle(record, TargetStatus::failed, missed(record), seen.time_s);
    }
  }
}

std::optional<Wait> wait_for_balls(StopTasks& tasks, double time_s) {
  constexpr double late_s = 0.1;
  if (tasks.waited_s == time_s) {
    for (FlyingBall& ball : tasks.flying) ball.lands_s = time_s - lost_s;
    return std::nullopt;
  }
  tasks.waited_s = time_s;
  double until_s = time_s;
  for (const FlyingBall& ball : tasks.flying) until_s = std::max(until_s, ball.lands_s);
  return Wait{until_s > time_s ? until_s : time_s + late_s};
}

}  // namespace outrider
