#include "outrider/jobs/guard/guard_mission.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "outrider/jobs/guard/stops.hpp"

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
  auto& pitches = mission.errands.front().pitches;
  if (!pitches.empty()) pitches.erase(pitches.begin());
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
  const auto place =
      another_place(problem, site, target_of(mission, target), seen.pose.position, problem.errors.position_m);
  // Behind the rest of this stop, before the next one.
  mission.errands.insert(mission.errands.begin() + 1, Errand{place.value_or(mission.last_place), {target}});
}

/// Goes to the nearest place to shoot at a target from, after the present errand.
void stop_for(GuardMission& mission, std::size_t target, const GuardProblem& problem, const Site& site) {
  const Vec2 end = mission.errands.front().place;
  const auto place = another_place(problem, site, target, end, 0.0);
  mission.errands.insert(mission.errands.begin() + 1, Errand{place.value_or(end), {target}});
}

/// The shots of the present errand in passing on that way. Who cannot be hit from it gets a stop.
std::vector<FireInPassing> shots_in_passing(GuardMission& mission, const std::vector<Vec2>& way,
                                            const Observation& seen, const GuardProblem& problem,
                                            const Site& site) {
  const auto targets = std::exchange(mission.errands.front().passing, {});
  std::vector<FireInPassing> shots;
  if (targets.empty()) return shots;
  PassingShots solver(problem, site);
  const auto hits = solver.along(seen.pose.heading_rad, way, {seen.gun_yaw_rad, seen.gun_pitch_rad}, targets);
  for (const PassingHit& hit : hits) {
    const Vec2 from = way[hit.leg - 1];
    const Vec2 to = way[hit.leg];
    TargetRecord& record = mission.records[hit.target];
    ++record.shots;
    record.shot = hit.shot;
    record.pose = {platform_on(problem.robot, from, to, hit.after_s).position, heading_of(to - from)};
    mission.passing.push_back(hit.target);
    shots.push_back({hit.target, hit.leg, hit.after_s, hit.shot.shot});
  }
  for (const std::size_t target : targets) {
    if (std::ranges::count(mission.passing, target) == 0) stop_for(mission, target, problem, site);
  }
  return shots;
}

/// What has become of the shots in passing.
void note_passing(GuardMission& mission, const Observation& seen, const GuardProblem& problem,
                  const Site& site) {
  for (const std::size_t target : std::exchange(mission.passing, {})) {
    TargetRecord& record = mission.records[target];
    const auto result = std::ranges::find(seen.passed, target, &PassingResult::target);
    if (result != seen.passed.end() && result->hit) {
      settle(record, TargetStatus::reached,
             fmt::format("hit by shot {} in passing from ({:.2f}, {:.2f})", record.shots,
                         record.pose.position.x, record.pose.position.y),
             result->landed_s);
    } else if (++record.tries < problem.tries) {
      stop_for(mission, target, problem, site);
    } else {
      settle(record, TargetStatus::failed, fmt::format("missed {} times", record.tries), seen.time_s);
    }
  }
}

/// The second pass: what failed is tried from another place, what had no shot without the margin.
void plan_second_pass(GuardMission& mission, const GuardProblem& problem, const Site& site) {
  mission.second_pass = true;
  ShotRules bold = site.rules;
  bold.margin_m = 0.0;
  for (std::size_t t = 0; t < mission.records.size(); ++t) {
    TargetRecord& record = mission.records[t];
    const std::size_t at = target_of(mission, t);
    record.tries = 0;
    if (record.status == TargetStatus::failed) {
      const auto place = another_place(problem, site, at, record.pose.position, problem.errors.position_m);
      mission.errands.push_back({place.value_or(record.pose.position), {t}});
    } else if (record.status == TargetStatus::unreachable && site.rules.margin_m > 0.0) {
      const Exhausted tried =
          exhaust(bold, site.space(at), problem.targets[at], site.frame, site.reachable, mission.stop);
      if (!tried.found) continue;
      mission.errands.push_back({site.frame.centre(site.frame.cell(*tried.found)), {t}});
    }
  }
}

/// The end of an errand to a station, where the gun is at rest.
Fill fill(GuardMission& mission) {
  const StationCall call = *mission.errands.front().call;
  mission.errands.pop_front();
  mission.arrived = false;
  mission.aimed = false;
  return {call};
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

/// Off to the place of the present errand, shooting in passing; nothing when the robot stands there.
std::optional<FollowWaypoints> set_off(GuardMission& mission, const Observation& seen,
                                       const GuardProblem& problem, const Site& site) {
  const Vec2 place = mission.errands.front().place;
  auto way = way_to(mission, seen, problem, site);
  auto shots = shots_in_passing(mission, way, seen, problem, site);
  mission.arrived = true;
  mission.last_place = place;
  if (distance(seen.pose.position, place) <= there_m) return std::nullopt;
  return FollowWaypoints{std::move(way), false, std::move(shots)};
}

/// Aims at the first target of the present errand from the pose really reached; nothing when it has no shot.
std::optional<AimGun> take_aim(GuardMission& mission, const Observation& seen, const GuardProblem& problem,
                               const Site& site) {
  const Errand& errand = mission.errands.front();
  const std::size_t target = errand.targets.front();
  const std::size_t at = target_of(mission, target);
  ShotRules rules = site.rules;
  if (mission.second_pass) rules.margin_m = 0.0;
  const double pitch = errand.pitches.empty() ? seen.gun_pitch_rad : errand.pitches.front();
  TargetRecord& record = mission.records[target];
  record.pose = seen.pose;
  const auto shot = best_shot(rules, site.space(at), problem.targets[at], seen.pose.position, pitch);
  if (!shot) return std::nullopt;
  record.shot = shot;
  mission.aimed = true;
  return AimGun{shot->shot.yaw_rad, shot->shot.pitch_rad};
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

std::size_t target_of(const GuardMission& mission, std::size_t record) {
  return mission.at.empty() ? record : mission.at[record];
}

GuardMission begin(const GuardProblem& problem, const GuardPlan& plan) {
  GuardMission mission;
  mission.records.resize(problem.targets.size());
  mission.last_place = problem.start.position;
  mission.routes = plan.routes;
  for (const Unreachable& lost : plan.unreachable) {
    settle(mission.records[lost.target], TargetStatus::unreachable, lost.reason, 0.0);
  }
  for (const Unreachable& lost : plan.unsupplied) {
    settle(mission.records[lost.target], TargetStatus::failed, lost.reason, 0.0);
  }
  for (const PlannedStop& stop : plan.stops) {
    Errand errand{stop.position, {}, stop.call};
    for (const PassingHit& hit : stop.passing) errand.passing.push_back(hit.target);
    for (const PlannedHit& hit : stop.hits) {
      errand.targets.push_back(hit.target);
      errand.pitches.push_back(hit.shot.gun.pitch_rad);
    }
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
  note_passing(mission, seen, problem, site);
  for (;;) {
    if (mission.errands.empty()) {
      if (mission.second_pass || mission.keeps_watch) return std::nullopt;
      plan_second_pass(mission, problem, site);
      continue;
    }
    const Errand& errand = mission.errands.front();
    if (errand.targets.empty() && errand.passing.empty() && !errand.call) {
      mission.errands.pop_front();
      mission.arrived = false;
      continue;
    }
    if (!mission.arrived) {
      if (auto drive = set_off(mission, seen, problem, site)) return std::move(*drive);
      continue;
    }
    if (errand.call) {
      if (!std::exchange(mission.aimed, true)) return AimGun{seen.pose.heading_rad, 0.0};
      return fill(mission);
    }
    if (!mission.aimed) {
      if (const auto aim = take_aim(mission, seen, problem, site)) return *aim;
      look_elsewhere(mission, seen, problem, site);
      continue;
    }
    const std::size_t target = errand.targets.front();
    TargetRecord& record = mission.records[target];
    ++record.shots;
    mission.fired = true;
    return Fire{target, record.shot->shot};
  }
}

}  // namespace outrider
