#include "flying_balls.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "outrider/jobs/guard/stops.hpp"

namespace outrider {
namespace {

constexpr double lost_s = 5.0;  // after the planned landing, a ball without a result

/// Shoots at a target from the first of the stops to come from which it is a sure hit; without any, from the
/// nearest place, after the present task.
void stop_for(StopTasks& tasks, std::size_t target, const GuardProblem& problem,
              const FiringMap& firing_map) {
  const std::vector<std::size_t> sure = SureCells(problem, firing_map).of(target_of(tasks, target));
  const auto serves = [&](const StopTask& task) {
    const Cell cell = firing_map.frame.cell_at(task.place);
    return !task.call && firing_map.frame.contains(cell) &&
           std::ranges::binary_search(sure, firing_map.frame.index(cell));
  };
  if (const auto task = std::ranges::find_if(tasks.queue, serves); task != tasks.queue.end()) {
    task->targets.push_back(target);
    return;
  }
  const bool idle = tasks.queue.empty();
  const Vec2 end = idle ? tasks.last_place : tasks.queue.front().place;
  const auto place = nearest_place(firing_map, sure, end, 0.0);
  tasks.queue.insert(tasks.queue.begin() + (idle ? 0 : 1), StopTask{place.value_or(end), {target}});
  if (idle) tasks.arrived = false;
}

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

/// The records that may be hit during the drive to the present task, no two at the same place. Drives to
/// stations are for the store alone.
std::vector<std::size_t> wanted_in_passing(const StopTasks& tasks) {
  const StopTask& task = tasks.queue.front();
  std::vector<std::size_t> wanted = task.passing;
  if (!tasks.on_the_move || task.call) return wanted;
  for (const std::size_t record : tasks.by_the_way) {
    const auto stands_there = [&](std::size_t other) {
      return target_of(tasks, other) == target_of(tasks, record);
    };
    if (std::ranges::none_of(wanted, stands_there)) wanted.push_back(record);
  }
  return wanted;
}

/// The number of shots for which there is water.
std::size_t shots_left(const Observation& seen, const GuardProblem& problem) {
  constexpr double rounding = 1e-9, many = 1e6;
  if (!seen.stores || !problem.supplies.ends(Store::water)) return static_cast<std::size_t>(many);
  const double shots = (1.0 + rounding) * seen.stores->water / problem.supplies.shot_water;
  return static_cast<std::size_t>(std::clamp(shots, 0.0, many));
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

std::optional<Vec2> nearest_place(const FiringMap& firing_map, const std::vector<std::size_t>& cells,
                                  Vec2 here, double apart_m) {
  std::optional<Vec2> best;
  double least = std::numeric_limits<double>::infinity();
  for (const std::size_t cell : cells) {
    const Vec2 place = firing_map.frame.centre(firing_map.frame.cell(cell));
    const double away = distance(here, place);
    if (away < apart_m || away >= least) continue;
    least = away;
    best = place;
  }
  return best;
}

std::string missed(const TargetRecord& record) {
  if (record.unanswered > 0) {
    return fmt::format(
        "no hit by {} shot{}, of which {} had no result: is the gun jammed, or its tank empty?", record.shots,
        record.shots == 1 ? "" : "s", record.unanswered);
  }
  return fmt::format("missed {} time{}", record.shots, record.shots == 1 ? "" : "s");
}

std::vector<FireInPassing> shots_in_passing(StopTasks& tasks, const std::vector<Vec2>& way,
                                            const Observation& seen, const GuardProblem& problem,
                                            const FiringMap& firing_map) {
  const std::vector<std::size_t> wanted = wanted_in_passing(tasks);
  auto planned = std::exchange(tasks.queue.front().passing, {});
  std::vector<FireInPassing> shots;
  if (wanted.empty()) return shots;
  std::vector<std::size_t> targets;
  for (const std::size_t record : wanted) targets.push_back(target_of(tasks, record));
  PassingShots solver(problem, firing_map);
  auto hits = solver.along(seen.odometry.heading_rad, way, {seen.gun->yaw_rad, seen.gun->pitch_rad}, targets);
  hits.resize(std::min(hits.size(), shots_left(seen, problem)));
  for (const PassingHit& hit : hits) {
    const auto nth = std::ranges::find(targets, hit.target) - targets.begin();
    const std::size_t record = wanted[static_cast<std::size_t>(nth)];
    note_shot(tasks, record, hit, way, seen, problem, firing_map);
    shots.push_back({record, hit.leg, hit.after_s, hit.shot.shot});
    take_off(tasks, record);
    std::erase(planned, record);
  }
  for (const std::size_t record : planned) stop_for(tasks, record, problem, firing_map);
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
    if (result == nullptr) ++record.unanswered;
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
