#include "outrider/execute/guard_mission.hpp"

#include <fmt/format.h>

#include <limits>
#include <utility>

#include "outrider/guard/stops.hpp"

namespace outrider {
namespace {

constexpr double there_m = 1e-6;

void settle(TargetRecord& record, TargetStatus status, std::string reason, double time_s) {
  record.status = status;
  record.reason = std::move(reason);
  record.done_s = time_s;
}

/// The nearest place, at least `apart_m` from here, from where the target can be hit; sure hits first.
std::optional<Vec2> another_place(const GuardProblem& problem, const Site& site, std::size_t target,
                                  Vec2 here, double apart_m) {
  const SureHits sure = sure_hits(problem, site);
  std::optional<Vec2> best;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < site.frame.size(); ++i) {
    if (!sure.has(i, target)) continue;
    const Vec2 place = site.frame.centre(site.frame.cell(i));
    const double away = distance(here, place);
    if (away < apart_m || away >= least) continue;
    least = away;
    best = place;
  }
  return best;
}

/// Takes the first target of the present errand off it.
void drop_target(GuardMission& mission) {
  auto& targets = mission.errands.front().targets;
  targets.erase(targets.begin());
  mission.aimed = false;
}

/// One more try at a target went wrong.
void note_failure(GuardMission& mission, std::size_t target, const GuardProblem& problem,
                  const std::string& what, double time_s) {
  TargetRecord& record = mission.records[target];
  ++record.tries;
  mission.aimed = false;
  if (record.tries < problem.tries) return;
  settle(record, TargetStatus::failed, what, time_s);
  drop_target(mission);
}

void note_result(GuardMission& mission, bool hit, const Observation& seen, const GuardProblem& problem) {
  const std::size_t target = mission.errands.front().targets.front();
  TargetRecord& record = mission.records[target];
  if (hit) {
    settle(record, TargetStatus::reached,
           fmt::format("hit by shot {} from ({:.2f}, {:.2f})", record.shots, record.pose.position.x,
                       record.pose.position.y),
           seen.time_s);
    drop_target(mission);
    return;
  }
  note_failure(mission, target, problem, fmt::format("missed {} times", record.tries + 1), seen.time_s);
}

/// What to do when the pose actually reached has no shot: go somewhere else, or give up.
void look_elsewhere(GuardMission& mission, const Observation& seen, const GuardProblem& problem,
                    const Site& site) {
  const std::size_t target = mission.errands.front().targets.front();
  const std::size_t left = mission.errands.front().targets.size();
  note_failure(mission, target, problem, "no shot from the places that the robot got to", seen.time_s);
  if (mission.errands.front().targets.size() < left) return;  // it was the last try
  drop_target(mission);
  const auto place = another_place(problem, site, target, seen.pose.position, problem.errors.position_m);
  // Behind the rest of this stop, before the next one.
  mission.errands.insert(mission.errands.begin() + 1, Errand{place.value_or(mission.last_place), {target}});
}

/// The second pass: what failed is tried from another place, what had no shot without the margin.
void plan_second_pass(GuardMission& mission, const GuardProblem& problem, const Site& site) {
  mission.second_pass = true;
  ShotRules bold = site.rules;
  bold.margin_m = 0.0;
  for (std::size_t t = 0; t < mission.records.size(); ++t) {
    TargetRecord& record = mission.records[t];
    record.tries = 0;
    if (record.status == TargetStatus::failed) {
      const auto place = another_place(problem, site, t, record.pose.position, problem.errors.position_m);
      mission.errands.push_back({place.value_or(record.pose.position), {t}});
    } else if (record.status == TargetStatus::unreachable && site.rules.margin_m > 0.0) {
      const Exhausted tried = exhaust(bold, site.space(t), problem.targets[t], site.frame, site.reachable);
      if (!tried.found) continue;
      mission.errands.push_back({site.frame.centre(site.frame.cell(*tried.found)), {t}});
    }
  }
}

/// Waypoints from where the robot stands to the place of the present errand.
std::vector<Vec2> way_to(const GuardMission& mission, const Observation& seen, const GuardProblem& problem,
                         const Site& site) {
  const Vec2 here = seen.pose.position;
  const Vec2 place = mission.errands.front().place;
  if (mission.routes) {
    if (auto route = mission.routes->route(seen.pose, place)) return std::move(route->waypoints);
  }
  // No corner of an obstacle is seen from here or from there: along the grid.
  if (const auto routes = site_routes(problem, site, {here, place}, {})) {
    if (auto way = routes->waypoints(0, 1); !way.empty()) return way;
  }
  return {here};
}

}  // namespace

std::string_view to_string(TargetStatus status) {
  switch (status) {
    case TargetStatus::waiting: return "waiting";
    case TargetStatus::reached: return "reached";
    case TargetStatus::failed: return "failed";
    case TargetStatus::unreachable: return "unreachable";
  }
  return "unknown";
}

GuardMission begin(const GuardProblem& problem, const GuardPlan& plan) {
  GuardMission mission;
  mission.records.resize(problem.targets.size());
  mission.last_place = problem.start.position;
  mission.routes = plan.routes;
  for (const Unreachable& lost : plan.unreachable) {
    settle(mission.records[lost.target], TargetStatus::unreachable, lost.reason, 0.0);
  }
  for (const PlannedStop& stop : plan.stops) {
    Errand errand{stop.position, {}};
    for (const PlannedHit& hit : stop.hits) errand.targets.push_back(hit.target);
    mission.errands.push_back(std::move(errand));
  }
  return mission;
}

void hear(GuardMission& mission, const Observation& seen, const GuardProblem& problem) {
  if (std::exchange(mission.fired, false)) note_result(mission, seen.hit.value_or(false), seen, problem);
}

std::optional<Command> step(GuardMission& mission, const Observation& seen, const GuardProblem& problem,
                            const Site& site) {
  hear(mission, seen, problem);
  for (;;) {
    if (mission.errands.empty()) {
      if (mission.second_pass || mission.keeps_watch) return std::nullopt;
      plan_second_pass(mission, problem, site);
      continue;
    }
    const Errand& errand = mission.errands.front();
    if (errand.targets.empty()) {
      mission.errands.pop_front();
      mission.arrived = false;
      continue;
    }
    if (!mission.arrived) {
      mission.arrived = true;
      auto way = way_to(mission, seen, problem, site);
      mission.last_place = errand.place;
      if (distance(seen.pose.position, errand.place) > there_m) return FollowWaypoints{std::move(way)};
      continue;
    }
    const std::size_t target = errand.targets.front();
    TargetRecord& record = mission.records[target];
    if (!mission.aimed) {
      ShotRules rules = site.rules;
      if (mission.second_pass) rules.margin_m = 0.0;
      const auto shot = best_shot(rules, site.space(target), problem.targets[target], seen.pose.position,
                                  seen.gun_pitch_rad);
      record.pose = seen.pose;
      if (!shot) {
        look_elsewhere(mission, seen, problem, site);
        continue;
      }
      record.shot = shot;
      mission.aimed = true;
      return AimGun{shot->shot.yaw_rad, shot->shot.pitch_rad};
    }
    ++record.shots;
    mission.fired = true;
    return Fire{target, record.shot->shot};
  }
}

}  // namespace outrider
