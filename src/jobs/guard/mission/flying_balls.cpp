#include "outrider/jobs/guard/mission/task_board.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "outrider/geometry/convex.hpp"
#include "yard/way_around.hpp"

namespace outrider {
namespace {

constexpr double lost_s = 5.0;  // after the planned landing, a ball without a result

bool has_stop(const std::deque<StopTask>& queue, std::size_t record) {
  return std::ranges::any_of(queue, [record](const StopTask& task) {
    return std::ranges::find(task.targets, record) != task.targets.end();
  });
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
std::size_t shots_left(const Observation& seen, const Supplies& supplies) {
  constexpr double rounding = 1e-9, many = 1e6;
  if (!seen.stores || !supplies.ends(Store::water)) return static_cast<std::size_t>(many);
  const double shots = (1.0 + rounding) * seen.stores->water / supplies.shot_water;
  return static_cast<std::size_t>(std::clamp(shots, 0.0, many));
}

/// Returns true if no leg comes nearer than `gap_m` to the middle of what is standing somewhere.
bool keeps_away(const std::vector<Vec2>& way, const std::vector<Vec2>& standing, double gap_m) {
  for (std::size_t i = 1; i < way.size(); ++i) {
    const Segment leg{way[i - 1], way[i]};
    if (std::ranges::any_of(standing, [&](Vec2 middle) { return distance(middle, leg) < gap_m; }))
      return false;
  }
  return true;
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

Outcome<std::vector<Vec2>> TaskBoard::way_between(const Pose2& from, Vec2 to) const {
  auto way = yard_way(*problem_, *firing_map_, routes_, from, to, budget_);
  if (!way) return way;
  if (way->empty()) way->push_back(from.position);
  auto [standing, gap_m] = keep_away_.value_or(KeepAway{{}, obstacle_gap_m(*problem_)});
  standing.insert(standing.end(), cut_.obstacles.begin(), cut_.obstacles.end());
  if (keeps_away(*way, standing, gap_m)) return way;
  auto around = way_around(*problem_, *firing_map_, from.position, to, standing, gap_m, budget_);
  return around ? std::move(*around) : std::move(*way);
}

/// Takes a target off the stops that were to hit it.
void TaskBoard::take_off(std::size_t target) {
  for (StopTask& task : queue_) {
    const auto at = std::ranges::find(task.targets, target);
    if (at == task.targets.end()) continue;
    const auto k = at - task.targets.begin();
    task.targets.erase(at);
    if (std::cmp_less(k, task.guns.size())) task.guns.erase(task.guns.begin() + k);
  }
}

/// The records that may be hit during the drive to the present task: first those that are to be, then those
/// by the way; no two at the same place. Drives to stations are for the store alone.
std::vector<std::size_t> TaskBoard::wanted_in_passing() {
  const StopTask& task = queue_.front();
  std::vector<std::size_t> wanted = task.passing;
  std::erase_if(lost_, [&](std::size_t record) { return !has_stop(queue_, record); });
  if (!on_the_move_ || !problem_->fires_driving || task.call) return wanted;
  for (const auto* records : {&by_the_way_, &lost_}) {
    for (const std::size_t record : *records) {
      const auto stands_there = [&](std::size_t other) { return target_of(other) == target_of(record); };
      if (std::ranges::none_of(wanted, stands_there)) wanted.push_back(record);
    }
  }
  return wanted;
}

/// Notes that a shot will be fired in passing.
void TaskBoard::note_shot(std::size_t target, const PassingHit& hit, const std::vector<Vec2>& way,
                          const Observation& seen) {
  const Vec2 from = way[hit.leg - 1];
  const Vec2 to = way[hit.leg];
  aim_at(target, hit.shot,
         {platform_on(problem_->robot, from, to, hit.after_s, firing_map_->ground.terrain()).position,
          heading_of(to - from)});
  const double leaves_s = seen.time_s + hit.leaves_s;
  launch({target, leaves_s + hit.shot.flight_s, true, leaves_s});
}

std::vector<FireInPassing> TaskBoard::shots_in_passing(const std::vector<Vec2>& way,
                                                       const Observation& seen) {
  const std::vector<std::size_t> wanted = wanted_in_passing();
  std::vector<FireInPassing> shots;
  if (wanted.empty()) return shots;
  auto planned = std::exchange(queue_.front().passing, {});
  std::vector<std::size_t> targets;
  for (const std::size_t record : wanted) targets.push_back(target_of(record));
  PassingShots solver(*problem_, *firing_map_);
  auto hits = hits_along(solver, seen, way, targets, planned.size());
  hits.resize(std::min(hits.size(), shots_left(seen, problem_->supplies)));
  for (const PassingHit& hit : hits) {
    const auto nth = std::ranges::find(targets, hit.target) - targets.begin();
    const std::size_t record = wanted[static_cast<std::size_t>(nth)];
    note_shot(record, hit, way, seen);
    shots.push_back({record, hit.leg, hit.after_s, hit.shot.shot});
    take_off(record);
    std::erase(planned, record);
  }
  for (const std::size_t record : planned) {
    stop_for(record);
    lost_.push_back(record);
  }
  return shots;
}

void TaskBoard::note_flying(const Observation& seen, bool again) {
  for (const FlyingBall& ball : std::exchange(flying_, {})) {
    TargetRecord& record = records_[ball.target];
    const ShotResult* const result = result_of(seen, ball.target);
    if (result == nullptr && !ball.awaited && seen.time_s < ball.lands_s + lost_s) {
      flying_.push_back(ball);
      continue;
    }
    if (result == nullptr && ball.unsure) {
      --record.shots;
      if (again) stop_for(ball.target);
      continue;
    }
    if (result == nullptr) ++record.unanswered;
    silence_.note(ball.target, result != nullptr, seen.time_s);
    if (result != nullptr && result->hit) {
      note_hit(ball.target, ball.in_passing ? " in passing" : "", result->landed_s);
    } else if (!again) {
      continue;
    } else if (++record.tries < problem_->tries) {
      stop_for(ball.target);
    } else {
      settle(ball.target, TargetStatus::failed, missed(record), seen.time_s);
    }
  }
}

std::optional<Wait> TaskBoard::wait_for_balls(double time_s) {
  constexpr double late_s = 0.1;
  if (waited_s_ == time_s) {
    for (FlyingBall& ball : flying_) ball.lands_s = time_s - lost_s;
    return std::nullopt;
  }
  waited_s_ = time_s;
  double until_s = time_s;
  for (const FlyingBall& ball : flying_) until_s = std::max(until_s, ball.lands_s);
  return Wait{until_s > time_s ? until_s : time_s + late_s};
}

}  // namespace outrider
