#include "outrider/jobs/guard/mission/task_board.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "outrider/ballistics/stance.hpp"
#include "outrider/core/units.hpp"
#include "outrider/jobs/guard/plan/stops.hpp"

namespace outrider {
namespace {

std::optional<Vec2> another_place(const GuardProblem& problem, const FiringMap& firing_map,
                                  std::size_t target, Vec2 here) {
  return nearest_place(firing_map, sure_cells(problem, firing_map, target), here, problem.errors.position_m);
}

/// Returns the nearest place from which a target that was missed can be hit by other flights: what is in the
/// way of one, and is on no map, stops those beside it. If there is none, returns the nearest of all.
std::optional<Vec2> place_aside(const GuardProblem& problem, const FiringMap& firing_map, std::size_t target,
                                Vec2 missed_from) {
  constexpr double aside_rad = radians(20.0);
  const Vec2 base = xy(problem.targets[target].base);
  const std::vector<std::size_t> all = sure_cells(problem, firing_map, target);
  std::vector<std::size_t> aside = all;
  std::erase_if(aside, [&](std::size_t cell) {
    const double off_rad =
        wrap_angle(heading_of(firing_map.place(cell) - base) - heading_of(missed_from - base));
    return std::abs(off_rad) < aside_rad;
  });
  return nearest_place(firing_map, aside.empty() ? all : aside, missed_from, problem.errors.position_m);
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

/// The direction of the barrel of a robot there, for these joint angles.
AimGun barrel(const FiringMap& firing_map, Vec2 place, const GunAngles& joints) {
  const Shot along = shot_of(stance_at(firing_map.rules, place), joints, 0.0);
  return {along.yaw_rad, along.pitch_rad};
}

AimGun gun_at_rest(const FiringMap& firing_map, const Pose2& robot) {
  const Stance stance = stance_at(firing_map.rules, robot.position);
  return barrel(firing_map, robot.position, {heading_on(stance, robot.heading_rad), 0.0});
}

}  // namespace

/// Takes the first target off the present task.
void TaskBoard::drop_target() {
  auto& targets = queue_.front().targets;
  targets.erase(targets.begin());
  auto& guns = queue_.front().guns;
  if (!guns.empty()) guns.erase(guns.begin());
  aimed_ = false;
}

/// One more try at a target went wrong. `last`: there is no other in this pass.
void TaskBoard::note_failure(std::size_t target, const std::string& what, double time_s, bool last) {
  TargetRecord& record = records_[target];
  ++record.tries;
  aimed_ = false;
  if (record.tries < problem_->tries && !last) return;
  settle(target, TargetStatus::failed, what, time_s);
  drop_target();
}

void TaskBoard::note_hit(std::size_t record, std::string_view how, double time_s) {
  const auto& [x, y] = records_[record].pose.position;
  settle(record, TargetStatus::reached,
         fmt::format("hit by shot {}{} from ({:.2f}, {:.2f})", records_[record].shots, how, x, y), time_s);
}

void TaskBoard::note_result(bool hit, const Observation& seen) {
  const std::size_t target = queue_.front().targets.front();
  TargetRecord& record = records_[target];
  if (hit) {
    note_hit(target, "", seen.time_s);
    drop_target();
    return;
  }
  const bool last = is_hopeless(*problem_, time_of_a_hit(*record.shot, 1, 0.0));
  note_failure(target, missed(record), seen.time_s, last);
}

/// Handles a reached pose that has no shot: goes somewhere else, or gives up.
void TaskBoard::look_elsewhere(const Observation& seen) {
  const std::size_t target = queue_.front().targets.front();
  const std::size_t left = queue_.front().targets.size();
  note_failure(target, "no shot from the places that the robot got to", seen.time_s);
  if (queue_.front().targets.size() < left) return;  // it was the last try
  drop_target();
  const auto place = another_place(*problem_, *firing_map_, target_of(target), seen.odometry.position);
  // Behind the rest of this stop, before the next one.
  queue_.insert(queue_.begin() + 1, StopTask{place.value_or(last_place_), {target}});
}

/// Returns true if the second pass leaves a failed target out, and says so in its reason: a hit from that
/// place would take too long.
bool TaskBoard::leaves_out(std::size_t target, Vec2 place) {
  const std::size_t at = target_of(target);
  ShotRules bold = firing_map_->rules;
  bold.margin_m = 0.0;
  const auto shot = best_shot(bold, firing_map_->space(at), problem_->targets[at], place, 0.0);
  if (!shot) return false;
  const double drive_s = distance(last_place_, place) / problem_->robot.speed_mps;
  const double hit_s = time_of_a_hit(*shot, problem_->tries, drive_s);
  if (!is_hopeless(*problem_, hit_s)) return false;
  records_[target].reason +=
      fmt::format("; given up, as a hit from elsewhere takes {:.0f} s on average", hit_s);
  return true;
}

/// The second pass: what failed is tried from another place, what had no shot without the margin.
void TaskBoard::plan_second_pass() {
  second_pass_ = true;
  ShotRules bold = firing_map_->rules;
  bold.margin_m = 0.0;
  for (std::size_t t = 0; t < records_.size(); ++t) {
    TargetRecord& record = records_[t];
    const std::size_t at = target_of(t);
    record.tries = 0;
    if (record.status == TargetStatus::failed) {
      const Vec2 here = record.pose.position;
      const auto other = record.shots > 0 ? place_aside(*problem_, *firing_map_, at, here)
                                          : another_place(*problem_, *firing_map_, at, here);
      const Vec2 place = other.value_or(here);
      if (!leaves_out(t, place)) queue_.push_back({place, {t}});
    } else if (record.status == TargetStatus::unreachable && firing_map_->rules.margin_m > 0.0) {
      const Exhausted tried = exhaust(bold, firing_map_->space(at), problem_->targets[at], firing_map_->frame,
                                      firing_map_->reachable, stop_);
      if (!tried.found) continue;
      queue_.push_back({firing_map_->place(*tried.found), {t}});
    }
  }
}

/// The end of an task to a station, where the gun is at rest.
Fill TaskBoard::fill() {
  const StationCall call = *queue_.front().call;
  drop_task();
  return {call};
}

/// Off to the place of the present task, shooting in passing; nothing when the robot stands there.
std::optional<Command> TaskBoard::set_off(const Observation& seen) {
  const Vec2 place = queue_.front().place;
  if (stays_here(seen)) return std::nullopt;
  auto way = way_between(seen.odometry, place);
  if (!way) return wait_for_planner(seen.time_s, way.error());
  planless_s_.reset();
  auto shots = shots_in_passing(*way, seen);
  arrived_ = true;
  last_place_ = place;
  if (distance(seen.odometry.position, place) <= there_m) return std::nullopt;
  cut_.driving = true;
  FollowWaypoints drive{std::move(*way), false, std::move(shots)};
  const StopTask& task = queue_.front();
  const auto& along = drive.waypoints;
  if (on_the_move_ && !task.guns.empty()) {
    drive.aim = barrel(*firing_map_, place, task.guns.front());
  } else if (on_the_move_ && task.call) {
    drive.aim = gun_at_rest(*firing_map_, {place, heading_of(along.back() - along[along.size() - 2])});
  }
  return drive;
}

/// Aims at the first target of the present task from the pose really reached; nothing when it has no shot.
std::optional<AimGun> TaskBoard::take_aim(const Observation& seen) {
  const StopTask& task = queue_.front();
  const std::size_t target = task.targets.front();
  const std::size_t at = target_of(target);
  ShotRules rules = firing_map_->rules;
  if (second_pass_) rules.margin_m = 0.0;
  const double pitch = task.guns.empty() ? seen.gun->pitch_rad : task.guns.front().pitch_rad;
  records_[target].pose = seen.odometry;
  const auto shot =
      best_shot(rules, firing_map_->space(at), problem_->targets[at], seen.odometry.position, pitch);
  if (!shot) return std::nullopt;
  aim_at(target, *shot, seen.odometry);
  aimed_ = true;
  return AimGun{shot->shot.yaw_rad, shot->shot.pitch_rad};
}

/// Returns true if the robot stands elsewhere than where the gun was aimed.
bool TaskBoard::moved_since(const Pose2& pose) const {
  constexpr double moved_m = 0.02, turned_rad = 0.02;
  const Pose2& aimed = records_[queue_.front().targets.front()].pose;
  return distance(aimed.position, pose.position) > moved_m ||
         std::abs(wrap_angle(aimed.heading_rad - pose.heading_rad)) > turned_rad;
}

/// Shoots at the first target of the present task, at which the gun is aimed.
Fire TaskBoard::fire(double time_s) {
  const std::size_t target = queue_.front().targets.front();
  const PlannedShot& shot = *records_[target].shot;
  const bool awaited = is_awaited(shot, on_the_move_);
  if (awaited) {
    ++records_[target].shots;
    fired_ = true;
  } else {
    launch({target, time_s + shot.flight_s, false, time_s});
    drop_target();
  }
  return {target, shot.shot, awaited};
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

TaskBoard::TaskBoard(const GuardProblem& problem, const FiringMap& firing_map, std::size_t records,
                     std::optional<Routes> routes, bool on_the_move)
    : problem_(&problem),
      firing_map_(&firing_map),
      records_(records),
      on_the_move_(on_the_move),
      last_place_(problem.start.position),
      routes_(std::move(routes)) {}

TaskBoard::TaskBoard(const GuardProblem& problem, const FiringMap& firing_map, const GuardPlan& plan)
    : TaskBoard(problem, firing_map, problem.targets.size(), plan.routes, plan.on_the_move) {
  for (const Unreachable& lost : plan.unreachable)
    settle(lost.target, TargetStatus::unreachable, lost.reason, 0.0);
  for (const Unreachable& lost : plan.unsupplied) settle(lost.target, TargetStatus::failed, lost.reason, 0.0);
  for (const PlannedStop& stop : plan.stops) {
    StopTask task{stop.position, {}, stop.call};
    for (const PassingHit& hit : stop.passing) task.passing.push_back(hit.target);
    for (const PlannedHit& hit : stop.hits) {
      task.targets.push_back(hit.target);
      task.guns.push_back(hit.shot.gun);
    }
    queue_.push_back(std::move(task));
  }
}

bool TaskBoard::is_in_air(std::size_t record) const {
  return std::ranges::count(flying_, record, &FlyingBall::target) > 0;
}

void TaskBoard::settle(std::size_t record, TargetStatus status, std::string reason, double time_s) {
  records_[record].status = status;
  records_[record].reason = std::move(reason);
  records_[record].done_s = time_s;
}

void TaskBoard::fail_waiting(const std::string& why, double time_s) {
  for (std::size_t i = 0; i < records_.size(); ++i) {
    if (records_[i].status == TargetStatus::waiting) settle(i, TargetStatus::failed, why, time_s);
  }
  queue_.clear();
}

void TaskBoard::set_tasks(std::deque<StopTask> tasks, bool arrived) {
  queue_ = std::move(tasks);
  arrived_ = arrived;
  aimed_ = false;
}

void TaskBoard::do_first(StopTask task) {
  queue_.push_front(std::move(task));
  arrived_ = aimed_ = false;
}

std::vector<std::size_t> TaskBoard::drop_task() {
  std::vector<std::size_t> targets = std::move(queue_.front().targets);
  queue_.pop_front();
  arrived_ = aimed_ = false;
  return targets;
}

void TaskBoard::drop_empty_tasks() {
  while (!queue_.empty() && queue_.front().targets.empty() && !queue_.front().call) {
    queue_.pop_front();
    arrived_ = false;
  }
}

void TaskBoard::survive(std::size_t record, std::size_t target) {
  for (std::size_t i = stands_at_.size(); i < records_.size(); ++i) stands_at_.push_back(i);
  stands_at_[record] = target;
  TargetRecord& again = records_[record];
  again = {TargetStatus::waiting, {}, again.shots, 0, again.shot, again.pose, 0.0};
  more_to_come_ = true;
  second_pass_ = false;  // there will be another, for all that have failed
}

void TaskBoard::aim_at(std::size_t record, const PlannedShot& shot, const Pose2& pose) {
  records_[record].shot = shot;
  records_[record].pose = pose;
}

void TaskBoard::launch(const FlyingBall& ball) {
  ++records_[ball.target].shots;
  flying_.push_back(ball);
}

void TaskBoard::take_back(std::size_t record) {
  --records_[record].shots;
  std::erase_if(flying_, [&](const FlyingBall& ball) { return ball.target == record; });
  if (std::exchange(fired_, false)) drop_target();
  aimed_ = false;
}

void TaskBoard::note_shots(const Observation& seen, bool again) {
  note_flying(seen, again);
  if (!std::exchange(fired_, false)) return;
  const std::size_t target = queue_.front().targets.front();
  const ShotResult* const result = result_of(seen, target);
  if (result == nullptr) ++records_[target].unanswered;
  silence_.note(target, result != nullptr, seen.time_s);
  note_result(result != nullptr && result->hit, seen);
}

std::optional<Command> TaskBoard::give_up_silent_gun(const Observation& seen) {
  std::string why = silence_.verdict(seen.time_s);
  if (why.empty()) return std::nullopt;
  if (!flying_.empty()) {
    if (const auto wait = wait_for_balls(seen.time_s)) return *wait;
  }
  given_up_ = std::move(why);
  fail_waiting(given_up_, seen.time_s);
  return std::nullopt;
}

/// Waits for the balls in the air, then plans the second pass. Nothing: there may be tasks again.
std::optional<Command> TaskBoard::go_on_without_tasks(const Observation& seen) {
  if (flying_.empty()) {
    plan_second_pass();
    return std::nullopt;
  }
  if (const auto wait = wait_for_balls(seen.time_s)) return *wait;
  note_flying(seen, true);
  return std::nullopt;
}

/// Returns the next command of the first task; nothing: look at the tasks again.
std::optional<Command> TaskBoard::go_on_with_task(const Observation& seen) {
  if (!arrived_) {
    if (auto drive = set_off(seen)) return std::move(*drive);
    return std::nullopt;
  }
  if (queue_.front().call) {
    if (!std::exchange(aimed_, true)) return gun_at_rest(*firing_map_, seen.odometry);
    return fill();
  }
  if (aimed_ && !moved_since(seen.odometry)) return fire(seen.time_s);
  aimed_ = false;
  if (const auto aim = take_aim(seen)) return *aim;
  look_elsewhere(seen);
  return std::nullopt;
}

std::optional<Command> TaskBoard::next_command(const Observation& seen) {
  if (auto wait = wait_if_held_up(seen)) return wait;
  while (given_up_.empty()) {
    if (queue_.empty()) {
      if (flying_.empty() && (second_pass_ || more_to_come_)) return std::nullopt;
      if (auto wait = go_on_without_tasks(seen)) return wait;
      continue;
    }
    const StopTask& task = queue_.front();
    if (task.targets.empty() && task.passing.empty() && !task.call) {
      queue_.pop_front();
      arrived_ = false;
      continue;
    }
    if (auto command = go_on_with_task(seen)) return command;
  }
  return std::nullopt;
}

std::optional<Command> TaskBoard::next_command_around(const Observation& seen, KeepAway others) {
  keep_away_ = std::move(others);
  auto command = next_command(seen);
  keep_away_.reset();
  return command;
}

}  // namespace outrider
