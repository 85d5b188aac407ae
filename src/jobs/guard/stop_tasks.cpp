#include "outrider/jobs/guard/stop_tasks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "flying_balls.hpp"
#include "lost_targets.hpp"
#include "outrider/ballistics/stance.hpp"
#include "outrider/jobs/guard/stops.hpp"
#include "team_detour.hpp"

namespace outrider {
namespace {

constexpr double held_up_s = 10.0;  ///< for which a robot waits that does not get away

std::optional<Vec2> another_place(const GuardProblem& problem, const FiringMap& firing_map,
                                  std::size_t target, Vec2 here, double apart_m) {
  return nearest_place(firing_map, SureCells(problem, firing_map).of(target), here, apart_m);
}

/// Takes the first target off the present task.
void drop_target(StopTasks& tasks) {
  auto& targets = tasks.queue.front().targets;
  targets.erase(targets.begin());
  auto& guns = tasks.queue.front().guns;
  if (!guns.empty()) guns.erase(guns.begin());
  tasks.aimed = false;
}

/// Returns the time that a hit takes on average with up to `tries` such shots after a drive, s.
double time_of_a_hit(const PlannedShot& shot, std::int64_t tries, double drive_s) {
  constexpr double least_rate = 0.5 / 27.0;  // hit rates are counted over 27 errors
  const double rate = std::max(shot.hit_rate, least_rate);
  const double any_hit = 1.0 - std::pow(1.0 - rate, static_cast<double>(tries));
  return drive_s / any_hit + shot.flight_s / rate;
}

/// Returns true if a target is not worth another shot.
bool is_hopeless(const GuardProblem& problem, double hit_s) {
  return problem.give_up_s > 0.0 && hit_s > problem.give_up_s;
}

/// One more try at a target went wrong. `last`: there is no other in this pass.
void note_failure(StopTasks& tasks, std::size_t target, const GuardProblem& problem, const std::string& what,
                  double time_s, bool last = false) {
  TargetRecord& record = tasks.records[target];
  ++record.tries;
  tasks.aimed = false;
  if (record.tries < problem.tries && !last) return;
  settle(record, TargetStatus::failed, what, time_s);
  drop_target(tasks);
}

void note_result(StopTasks& tasks, bool hit, const Observation& seen, const GuardProblem& problem) {
  const std::size_t target = tasks.queue.front().targets.front();
  TargetRecord& record = tasks.records[target];
  if (hit) {
    settle(record, TargetStatus::reached,
           fmt::format("hit by shot {} from ({:.2f}, {:.2f})", record.shots, record.pose.position.x,
                       record.pose.position.y),
           seen.time_s);
    drop_target(tasks);
    return;
  }
  const bool last = is_hopeless(problem, time_of_a_hit(*record.shot, 1, 0.0));
  note_failure(tasks, target, problem, missed(record), seen.time_s, last);
}

/// What to do when the pose actually reached has no shot: go somewhere else, or give up.
void look_elsewhere(StopTasks& tasks, const Observation& seen, const GuardProblem& problem,
                    const FiringMap& firing_map) {
  const std::size_t target = tasks.queue.front().targets.front();
  const std::size_t left = tasks.queue.front().targets.size();
  note_failure(tasks, target, problem, "no shot from the places that the robot got to", seen.time_s);
  if (tasks.queue.front().targets.size() < left) return;  // it was the last try
  drop_target(tasks);
  const auto place = another_place(problem, firing_map, target_of(tasks, target), seen.odometry.position,
                                   problem.errors.position_m);
  // Behind the rest of this stop, before the next one.
  tasks.queue.insert(tasks.queue.begin() + 1, StopTask{place.value_or(tasks.last_place), {target}});
}

/// Returns true if the second pass leaves a failed target out, and says so in its reason: a hit from that
/// place would take too long.
bool leaves_out(StopTasks& tasks, std::size_t target, Vec2 place, const GuardProblem& problem,
                const FiringMap& firing_map) {
  const std::size_t at = target_of(tasks, target);
  ShotRules bold = firing_map.rules;
  bold.margin_m = 0.0;
  const auto shot = best_shot(bold, firing_map.space(at), problem.targets[at], place, 0.0);
  if (!shot) return false;
  const double drive_s = distance(tasks.last_place, place) / problem.robot.speed_mps;
  const double hit_s = time_of_a_hit(*shot, problem.tries, drive_s);
  if (!is_hopeless(problem, hit_s)) return false;
  tasks.records[target].reason +=
      fmt::format("; given up, as a hit from elsewhere takes {:.0f} s on average", hit_s);
  return true;
}

/// The second pass: what failed is tried from another place, what had no shot without the margin.
void plan_second_pass(StopTasks& tasks, const GuardProblem& problem, const FiringMap& firing_map) {
  tasks.second_pass = true;
  ShotRules bold = firing_map.rules;
  bold.margin_m = 0.0;
  for (std::size_t t = 0; t < tasks.records.size(); ++t) {
    TargetRecord& record = tasks.records[t];
    const std::size_t at = target_of(tasks, t);
    record.tries = 0;
    if (record.status == TargetStatus::failed) {
      const Vec2 place =
          another_place(problem, firing_map, at, record.pose.position, problem.errors.position_m)
              .value_or(record.pose.position);
      if (!leaves_out(tasks, t, place, problem, firing_map)) tasks.queue.push_back({place, {t}});
    } else if (record.status == TargetStatus::unreachable && firing_map.rules.margin_m > 0.0) {
      const Exhausted tried = exhaust(bold, firing_map.space(at), problem.targets[at], firing_map.frame,
                                      firing_map.reachable, tasks.stop);
      if (!tried.found) continue;
      tasks.queue.push_back({firing_map.frame.centre(firing_map.frame.cell(*tried.found)), {t}});
    }
  }
}

/// The end of an task to a station, where the gun is at rest.
Fill fill(StopTasks& tasks) {
  const StationCall call = *tasks.queue.front().call;
  tasks.queue.pop_front();
  tasks.arrived = false;
  tasks.aimed = false;
  return {call};
}

/// The direction of the barrel of a robot there, for these joint angles.
AimGun barrel(const FiringMap& firing_map, Vec2 place, const GunAngles& joints) {
  const Shot along = shot_of(stance_at(firing_map.rules, place), joints, 0.0);
  return {along.yaw_rad, along.pitch_rad};
}

AimGun gun_at_rest(const FiringMap& firing_map, const Pose2& robot) {
  const Stance stance = stance_at(firing_map.rules, robot.position);
  return barrel(firing_map, robot.position, {heading_on(stance, robot.heading_rad), 0.0});
}

/// Gives all waiting targets up.
void give_up(StopTasks& tasks, std::string why, double time_s) {
  for (TargetRecord& record : tasks.records) {
    if (record.status == TargetStatus::waiting) settle(record, TargetStatus::failed, why, time_s);
  }
  tasks.queue.clear();
  tasks.given_up = std::move(why);
}

/// Waits for the planner to have a budget again; nothing: it has waited for long enough, and gives up.
std::optional<Command> wait_for_planner(StopTasks& tasks, double time_s, const Fault& fault) {
  constexpr double patience_s = 30.0, again_s = 1.0;
  const double since_s = tasks.planless_s.value_or(time_s);
  tasks.planless_s = since_s;
  if (time_s - since_s < patience_s) return Wait{time_s + again_s};
  give_up(tasks, fmt::format("no way can be planned since {:.1f} s: {}", since_s, fault.sentence), time_s);
  return std::nullopt;
}

/// Off to the place of the present task, shooting in passing; nothing when the robot stands there.
std::optional<Command> set_off(StopTasks& tasks, const Observation& seen, const GuardProblem& problem,
                               const FiringMap& firing_map) {
  const Vec2 place = tasks.queue.front().place;
  auto way = way_between(tasks, seen.odometry, place, problem, firing_map);
  if (!way) return wait_for_planner(tasks, seen.time_s, way.error());
  tasks.planless_s.reset();
  auto shots = shots_in_passing(tasks, *way, seen, problem, firing_map);
  if (!shots) return set_off(tasks, seen, problem, firing_map);
  tasks.arrived = true;
  tasks.last_place = place;
  if (distance(seen.odometry.position, place) <= there_m) return std::nullopt;
  tasks.cut.driving = true;
  FollowWaypoints drive{std::move(*way), false, std::move(*shots)};
  const StopTask& task = tasks.queue.front();
  const auto& along = drive.waypoints;
  if (tasks.on_the_move && !task.guns.empty()) {
    drive.aim = barrel(firing_map, place, task.guns.front());
  } else if (tasks.on_the_move && task.call) {
    drive.aim = gun_at_rest(firing_map, {place, heading_of(along.back() - along[along.size() - 2])});
  }
  return drive;
}

/// Aims at the first target of the present task from the pose really reached; nothing when it has no shot.
std::optional<AimGun> take_aim(StopTasks& tasks, const Observation& seen, const GuardProblem& problem,
                               const FiringMap& firing_map) {
  const StopTask& task = tasks.queue.front();
  const std::size_t target = task.targets.front();
  const std::size_t at = target_of(tasks, target);
  ShotRules rules = firing_map.rules;
  if (tasks.second_pass) rules.margin_m = 0.0;
  const double pitch = task.guns.empty() ? seen.gun->pitch_rad : task.guns.front().pitch_rad;
  TargetRecord& record = tasks.records[target];
  record.pose = seen.odometry;
  const auto shot =
      best_shot(rules, firing_map.space(at), problem.targets[at], seen.odometry.position, pitch);
  if (!shot) return std::nullopt;
  record.shot = shot;
  tasks.aimed = true;
  return AimGun{shot->shot.yaw_rad, shot->shot.pitch_rad};
}

/// Returns true if the robot stands elsewhere than where the gun was aimed.
bool moved_since(const StopTasks& tasks, const Pose2& pose) {
  constexpr double moved_m = 0.02, turned_rad = 0.02;
  const Pose2& aimed = tasks.records[tasks.queue.front().targets.front()].pose;
  return distance(aimed.position, pose.position) > moved_m ||
         std::abs(wrap_angle(aimed.heading_rad - pose.heading_rad)) > turned_rad;
}

/// Shoots at the first target of the present task, at which the gun is aimed.
Fire fire(StopTasks& tasks, double time_s) {
  const std::size_t target = tasks.queue.front().targets.front();
  TargetRecord& record = tasks.records[target];
  ++record.shots;
  const PlannedShot& shot = *record.shot;
  const bool awaited = is_awaited(shot, tasks.on_the_move);
  if (awaited) {
    tasks.fired = true;
  } else {
    tasks.flying.push_back({target, time_s + shot.flight_s, false, time_s});
    drop_target(tasks);
  }
  return {target, shot.shot, awaited};
}

}  // namespace

Outcome<std::vector<Vec2>> way_between(const StopTasks& tasks, const Pose2& from, Vec2 to,
                                       const GuardProblem& problem, const FiringMap& firing_map) {
  if (tasks.keep_away || !tasks.cut.obstacles.empty()) {
    auto [standing, gap_m] = tasks.keep_away.value_or(KeepAway{{}, obstacle_gap_m(problem)});
    standing.insert(standing.end(), tasks.cut.obstacles.begin(), tasks.cut.obstacles.end());
    if (auto way = way_around(problem, firing_map, from.position, to, standing, gap_m, tasks.budget))
      return std::move(*way);
  }
  if (tasks.routes) {
    auto route = tasks.routes->route(from, to, tasks.budget);
    if (route) return std::move(route->waypoints);
    if (route.error().code == FaultCode::budget_exhausted) return pass_on(route);
  }
  // No corner of an obstacle is seen from here or from there: along the grid.
  auto routes = yard_routes(problem, firing_map, {from.position, to}, tasks.budget);
  if (!routes && routes.error().code == FaultCode::budget_exhausted) return pass_on(routes);
  if (routes) {
    if (auto way = routes->waypoints(0, 1); !way.empty()) return way;
  }
  return std::vector<Vec2>{from.position};
}

void settle(TargetRecord& record, TargetStatus status, std::string reason, double time_s) {
  record.status = status;
  record.reason = std::move(reason);
  record.done_s = time_s;
}

std::string_view to_string(TargetStatus status) {
  switch (status) {
    case TargetStatus::waiting: return "waiting";
    case TargetStatus::reached: return "reached";
    case TargetStatus::failed: return "failed";
    case TargetStatus::unreachable: return "unreachable";
  }
  return "unknown";
}

std::size_t target_of(const StopTasks& tasks, std::size_t record) {
  return tasks.stands_at.empty() ? record : tasks.stands_at[record];
}

StopTasks tasks_of(const GuardProblem& problem, const GuardPlan& plan) {
  StopTasks tasks;
  tasks.records.resize(problem.targets.size());
  tasks.last_place = problem.start.position;
  tasks.routes = plan.routes;
  tasks.on_the_move = plan.on_the_move;
  for (const Unreachable& lost : plan.unreachable) {
    settle(tasks.records[lost.target], TargetStatus::unreachable, lost.reason, 0.0);
  }
  for (const Unreachable& lost : plan.unsupplied) {
    settle(tasks.records[lost.target], TargetStatus::failed, lost.reason, 0.0);
  }
  for (const PlannedStop& stop : plan.stops) {
    StopTask task{stop.position, {}, stop.call};
    for (const PassingHit& hit : stop.passing) task.passing.push_back(hit.target);
    for (const PlannedHit& hit : stop.hits) {
      task.targets.push_back(hit.target);
      task.guns.push_back(hit.shot.gun);
    }
    tasks.queue.push_back(std::move(task));
  }
  return tasks;
}

void note_shots(StopTasks& tasks, const Observation& seen, const GuardProblem& problem,
                const FiringMap& firing_map) {
  note_flying(tasks, seen, problem, firing_map);
  if (!std::exchange(tasks.fired, false)) return;
  const std::size_t target = tasks.queue.front().targets.front();
  const ShotResult* const result = result_of(seen, target);
  if (result == nullptr) ++tasks.records[target].unanswered;
  tasks.silence.note(target, result != nullptr, seen.time_s);
  note_result(tasks, result != nullptr && result->hit, seen, problem);
}

std::optional<Command> give_up_silent_gun(StopTasks& tasks, const Observation& seen) {
  std::string why = tasks.silence.verdict(seen.time_s);
  if (why.empty()) return std::nullopt;
  if (!tasks.flying.empty()) {
    if (const auto wait = wait_for_balls(tasks, seen.time_s)) return *wait;
  }
  give_up(tasks, std::move(why), seen.time_s);
  return std::nullopt;
}

namespace {

/// Looks where the drive to the present task has ended. Returns a command if the robot is held up.
std::optional<Command> wait_if_held_up(StopTasks& tasks, const Observation& seen,
                                       const GuardProblem& problem) {
  if (!tasks.cut.driving || tasks.queue.empty()) return std::nullopt;
  const AfterDrive next = after_drive(tasks, seen, problem);
  tasks.arrived = next == AfterDrive::go_on;
  if (next == AfterDrive::wait) return Wait{seen.time_s + held_up_s};
  return std::nullopt;
}

/// Waits for the balls in the air, then plans the second pass. Nothing: there may be tasks again.
std::optional<Command> go_on_without_tasks(StopTasks& tasks, const Observation& seen,
                                           const GuardProblem& problem, const FiringMap& firing_map) {
  if (tasks.flying.empty()) {
    plan_second_pass(tasks, problem, firing_map);
    return std::nullopt;
  }
  if (const auto wait = wait_for_balls(tasks, seen.time_s)) return *wait;
  note_flying(tasks, seen, problem, firing_map);
  return std::nullopt;
}

/// Returns the next command of the first task; nothing: look at the tasks again.
std::optional<Command> go_on_with_task(StopTasks& tasks, const Observation& seen, const GuardProblem& problem,
                                       const FiringMap& firing_map) {
  if (!tasks.arrived) {
    if (auto drive = set_off(tasks, seen, problem, firing_map)) return std::move(*drive);
    return std::nullopt;
  }
  if (tasks.queue.front().call) {
    if (!std::exchange(tasks.aimed, true)) return gun_at_rest(firing_map, seen.odometry);
    return fill(tasks);
  }
  if (tasks.aimed && !moved_since(tasks, seen.odometry)) return fire(tasks, seen.time_s);
  tasks.aimed = false;
  if (const auto aim = take_aim(tasks, seen, problem, firing_map)) return *aim;
  look_elsewhere(tasks, seen, problem, firing_map);
  return std::nullopt;
}

}  // namespace

std::optional<Command> next_command(StopTasks& tasks, const Observation& seen, const GuardProblem& problem,
                                    const FiringMap& firing_map) {
  if (auto wait = wait_if_held_up(tasks, seen, problem)) return wait;
  while (tasks.given_up.empty()) {
    if (tasks.queue.empty()) {
      if (tasks.flying.empty() && (tasks.second_pass || tasks.more_to_come)) return std::nullopt;
      if (auto wait = go_on_without_tasks(tasks, seen, problem, firing_map)) return wait;
      continue;
    }
    const StopTask& task = tasks.queue.front();
    if (task.targets.empty() && task.passing.empty() && !task.call) {
      tasks.queue.pop_front();
      tasks.arrived = false;
      continue;
    }
    if (auto command = go_on_with_task(tasks, seen, problem, firing_map)) return command;
  }
  return std::nullopt;
}

}  // namespace outrider
