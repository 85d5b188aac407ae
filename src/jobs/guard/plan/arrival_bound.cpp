#include "outrider/jobs/guard/plan/bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace outrider {
namespace {

constexpr double unbounded = std::numeric_limits<double>::infinity();

struct Nearest {
  double from_start_m = unbounded;
  double to_target_m = unbounded;
};

/// How far from the centre of a cell a shot of it may leave.
double off_m(const ArrivalYard& watch, bool on_the_move) {
  const GuardProblem& problem = watch.problem;
  const double at_stop = problem.errors.position_m;
  if (!on_the_move) return at_stop;
  const double half_diagonal = std::numbers::sqrt2 / 2.0 * watch.firing_map.frame.resolution_m;
  return at_stop + half_diagonal + problem.robot.speed_mps * problem.errors.timing_s;
}

/// Least straight-line distances to and from the cells of a region, less what a shot may be off them.
Nearest nearest(const ArrivalYard& watch, std::size_t i, bool on_the_move) {
  const GuardProblem& problem = watch.problem;
  Nearest least;
  watch.firing_map.regions[i].pitch.each([&](std::size_t c, std::uint8_t pitch) {
    if (pitch == FiringRegion::no_shot) return;
    const Vec2 place = watch.firing_map.place(c);
    least.from_start_m = std::min(least.from_start_m, distance(problem.start.position, place));
    least.to_target_m = std::min(least.to_target_m, distance(xy(problem.targets[i].base), place));
  });
  const double off = off_m(watch, on_the_move);
  least.from_start_m = std::max(0.0, least.from_start_m - off);
  least.to_target_m = std::max(0.0, least.to_target_m - off);
  return least;
}

ReleasedWork job_of(const ArrivalYard& watch, std::size_t i, bool on_the_move) {
  const GuardProblem& problem = watch.problem;
  const Target& target = problem.targets[i];
  const Nearest least = nearest(watch, i, on_the_move);
  const double tip = std::hypot(problem.gun.tip_forward_m, problem.gun.tip_up_m);
  const double gap =
      least.to_target_m - tip - 0.5 * std::hypot(target.size.x, target.size.y) - problem.gun.ball_radius_m;
  const double fastest = problem.gun.muzzle_speed_mps * (1.0 + problem.errors.aim.speed_ratio) +
                         (on_the_move ? problem.robot.speed_mps : 0.0);
  // A robot that does not stop there needs half of the time for twice the way from rest to rest.
  const Limits straight = problem.robot.straight();
  const double there_s = on_the_move ? 0.5 * duration(2.0 * least.from_start_m, straight)
                                     : duration(least.from_start_m, straight);
  return {std::max(watch.intruders[i].settles_s, there_s), std::max(0.0, gap) / fastest};
}

}  // namespace

double least_completion_sum(std::vector<ReleasedWork> jobs) {
  std::stable_sort(jobs.begin(), jobs.end(),
                   [](const ReleasedWork& a, const ReleasedWork& b) { return a.release_s < b.release_s; });
  std::vector<double> rests;  // of the jobs released, the shortest last
  double now = 0.0;
  double sum = 0.0;
  for (std::size_t next = 0; next < jobs.size() || !rests.empty();) {
    if (rests.empty()) now = std::max(now, jobs[next].release_s);
    while (next < jobs.size() && jobs[next].release_s <= now) rests.push_back(jobs[next++].work_s);
    std::sort(rests.begin(), rests.end(), std::greater<>());
    const double until = next < jobs.size() ? jobs[next].release_s : unbounded;
    if (now + rests.back() <= until) {
      now += rests.back();
      sum += now;
      rests.pop_back();
    } else {
      rests.back() -= until - now;
      now = until;
    }
  }
  return sum;
}

ArrivalBound arrival_bound(const ArrivalYard& watch, bool on_the_move) {
  std::vector<ReleasedWork> jobs;
  double entered = 0.0;
  for (std::size_t i = 0; i < watch.intruders.size(); ++i) {
    if (watch.firing_map.regions[i].hits == 0) continue;
    jobs.push_back(job_of(watch, i, on_the_move));
    entered += watch.intruders[i].enters_s;
  }
  ArrivalBound bound;
  if (on_the_move) {  // any number of balls may fly at a time
    bound.time_inside_s = -entered;
    for (const ReleasedWork& job : jobs) {
      bound.time_inside_s += job.release_s + job.work_s;
      bound.makespan_s = std::max(bound.makespan_s, job.release_s + job.work_s);
    }
    return bound;
  }
  bound.time_inside_s = least_completion_sum(jobs) - entered;
  for (const ReleasedWork& first : jobs) {
    double end = first.release_s;
    for (const ReleasedWork& job : jobs) end += job.release_s >= first.release_s ? job.work_s : 0.0;
    bound.makespan_s = std::max(bound.makespan_s, end);
  }
  return bound;
}

}  // namespace outrider
