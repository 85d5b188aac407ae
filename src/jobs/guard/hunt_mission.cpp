#include "outrider/jobs/guard/hunt_mission.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace outrider {
namespace {

constexpr std::size_t flown = 32;    // futures that a shot is flown at
constexpr std::size_t futures = 24;  // that a stop is judged by
constexpr double horizon_s = 60.0;   // of these
constexpr double flight_horizon_s = 10.0;
constexpr double worth_moving_s = 1.0;
constexpr double region_m = 1.1;  // a rest within this distance of a region is taken for one there
constexpr std::size_t nowhere = std::numeric_limits<std::size_t>::max();

bool hunted(const HuntMission& mission, std::size_t who) {
  return mission.records[who].status == TargetStatus::waiting && !mission.tracks[who].empty();
}

void look(HuntMission& mission, const Observation& seen, const WanderOptions& options) {
  for (const Glimpsed& glimpse : seen.glimpses) {
    mission.tracks[glimpse.target].push_back({glimpse.time_s, glimpse.position});
  }
  if (!options.learn) return;
  // In pieces of a few looks, so that a rest is told from a step.
  constexpr std::size_t piece = 20;
  for (std::size_t who = 0; who < mission.tracks.size(); ++who) {
    const Track& track = mission.tracks[who];
    if (track.size() < mission.learned[who] + piece) continue;
    learn(mission.map, track, options, mission.learned[who]);
    mission.learned[who] = track.size() - 1;
  }
}

void hear(HuntMission& mission, const Observation& seen) {
  if (!std::exchange(mission.fired, false)) return;
  TargetRecord& record = mission.records[mission.prey];
  if (!seen.hit.value_or(false)) return;
  record.status = TargetStatus::reached;
  record.done_s = mission.last_hit_s = seen.time_s;
  record.reason = fmt::format("hit by shot {} from ({:.2f}, {:.2f})", record.shots, record.pose.position.x,
                              record.pose.position.y);
}

/// The part of the possible futures, under the errors of the gun, in which the shot hits.
double chance_of(const HuntMission& mission, const HuntPlan& plan, std::size_t who, const LedShot& led,
                 Vec2 position, Rng rng) {
  const ShotRules& rules = plan.site.rules;
  const Stride stride = stride_of(mission.tracks[who], plan.options);
  std::size_t hits = 0;
  for (std::size_t i = 0; i < flown; ++i) {
    const Walk walk = possible_future(mission.map, stride, led.meets_s + 1.0, rng);
    Shot shot = led.planned.shot;
    shot.yaw_rad += rules.errors.gun_rad * rng.uniform(-1.0, 1.0);
    shot.pitch_rad += rules.errors.gun_rad * rng.uniform(-1.0, 1.0);
    shot.speed_mps *= 1.0 + rules.errors.speed_ratio * rng.uniform(-1.0, 1.0);
    const Flight flight = launch(rules.gun, position, rules.floor_z_m, shot, rules.gravity_mps2);
    hits += fly_at(flight, rules.gun.ball_radius_m, plan.site.space(who), plan.problem.targets[who], walk,
                   led.fires_s, rules.floor_z_m)
                    .hit
                ? 1U
                : 0U;
  }
  return static_cast<double>(hits) / static_cast<double>(flown);
}

/// The soonest shot that is likely enough, if there is one.
std::optional<LedShot> likely_shot(HuntMission& mission, const Observation& seen, const HuntPlan& plan,
                                   const Rng& rng) {
  std::optional<LedShot> best;
  const double yaw_rad = wrap_angle(seen.pose.heading_rad + seen.gun_yaw_rad);
  for (std::size_t who = 0; who < mission.tracks.size(); ++who) {
    if (!hunted(mission, who)) continue;
    const Walk walk =
        straight_on(stride_of(mission.tracks[who], plan.options), seen.time_s + flight_horizon_s);
    const auto led = led_shot(plan.site.rules, plan.site.space(who), plan.problem.targets[who], walk,
                              seen.pose.position, yaw_rad, seen.gun_pitch_rad, seen.time_s);
    if (!led || (best && best->meets_s <= led->meets_s)) continue;
    const double chance = chance_of(mission, plan, who, *led, seen.pose.position, rng.child(who));
    if (chance < plan.options.chance) continue;
    best = led;
    mission.prey = who;
    mission.chance = chance;
    mission.expected_at = walk.at(led->meets_s);
  }
  return best;
}

/// A rest to come: where, as a region, and when.
struct Rest {
  std::size_t region = nowhere;
  double from_s = 0.0;
  double until_s = 0.0;
};

std::vector<Rest> rests_of(const Walk& walk, const std::vector<Vec2>& regions) {
  std::vector<Rest> rests;
  for (std::size_t i = 0; i + 1 < walk.knots.size(); ++i) {
    const auto& [from_s, place] = walk.knots[i];
    if (!(place == walk.knots[i + 1].position)) continue;
    const auto nearest = std::min_element(regions.begin(), regions.end(), [&, at = place](Vec2 a, Vec2 b) {
      return squared_norm(a - at) < squared_norm(b - at);
    });
    if (distance(*nearest, place) > region_m) continue;
    rests.push_back({static_cast<std::size_t>(nearest - regions.begin()), from_s, walk.knots[i + 1].time_s});
  }
  return rests;
}

/// By future, the rests of all.
std::vector<std::vector<Rest>> imagine(const HuntMission& mission, double now_s, const HuntPlan& plan,
                                       const Rng& rng) {
  std::vector<std::vector<Rest>> all(futures);
  for (std::size_t who = 0; who < mission.tracks.size(); ++who) {
    if (!hunted(mission, who)) continue;
    const Stride stride = stride_of(mission.tracks[who], plan.options);
    Rng draws = rng.child(who);
    for (std::vector<Rest>& rests : all) {
      const auto own =
          rests_of(possible_future(mission.map, stride, now_s + horizon_s, draws), mission.map.regions);
      rests.insert(rests.end(), own.begin(), own.end());
    }
  }
  return all;
}

/// Until somebody rests where it is hit from the stop, on average, s.
double expected_wait(const std::vector<char>& hit_from_here, const std::vector<std::vector<Rest>>& all,
                     double there_s, double now_s) {
  double sum = 0.0;
  for (const std::vector<Rest>& rests : all) {
    double soonest = now_s + horizon_s;
    for (const Rest& rest : rests) {
      if (rest.until_s > there_s && hit_from_here[rest.region] != 0) {
        soonest = std::min(soonest, std::max(there_s, rest.from_s));
      }
    }
    sum += std::max(soonest, there_s) - now_s;
  }
  return sum / static_cast<double>(all.size());
}

/// The stop with the least expected time to a shot. Where the robot is nobody can be shot at now, or it would
/// be.
std::size_t best_stop(const HuntMission& mission, const Observation& seen, const HuntPlan& plan,
                      const Rng& rng) {
  const auto all = imagine(mission, seen.time_s, plan, rng);
  const Outlook& outlook = plan.outlook;
  std::size_t best = mission.stop;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < outlook.stops.size(); ++i) {
    const std::size_t stop = i == 0 ? mission.stop : i == mission.stop ? 0 : i;  // this one first
    std::vector<char> hit_from_here(mission.map.regions.size(), 0);
    for (const Service& service : outlook.table.services[stop]) hit_from_here[service.goal] = 1;
    double there_s = seen.time_s + plan.options.look_s;
    if (stop != mission.stop) {
      const Drive drive = outlook.routes.between(mission.stop, stop);
      if (!std::isfinite(drive.time_s)) continue;
      there_s = seen.time_s + drive.time_s +
                duration(std::abs(wrap_angle(drive.departure_rad - seen.pose.heading_rad)),
                         plan.problem.robot.turning());
    }
    const double wait = expected_wait(hit_from_here, all, there_s, seen.time_s);
    if (wait < least - (best == mission.stop && i > 0 ? worth_moving_s : 0.0)) {
      least = wait;
      best = stop;
    }
  }
  return best;
}

void give_up(HuntMission& mission, double now_s, const WanderOptions& options) {
  for (TargetRecord& record : mission.records) {
    if (record.status != TargetStatus::waiting) continue;
    record.status = TargetStatus::failed;
    record.reason = fmt::format("nobody was hit for {:g} s", options.patience_s);
    record.done_s = now_s;
  }
}

}  // namespace

Outcome<HuntPlan> plan_hunt(const GuardProblem& problem, const Site& site, const VisitMap& map,
                            const GuardOptions& options, const WanderOptions& wander, const Budget& budget) {
  GuardProblem regions = problem;
  regions.targets.clear();
  for (const Vec2 region : map.regions) {
    Target target = moved_to(problem.targets.front(), region);
    target.name = fmt::format("region_{}", regions.targets.size());
    target.base.z = site.rules.floor_z_m;
    regions.targets.push_back(std::move(target));
  }
  GuardOptions coarse = options;
  coarse.resolution_m = std::max(options.resolution_m, 0.2);
  auto surveyed = survey(regions, coarse, budget);
  if (!surveyed) return pass_on(surveyed);
  auto outlook = look_out(regions, *surveyed, {}, {}, budget);
  if (!outlook) return pass_on(outlook);
  return HuntPlan{problem, site, map, std::move(*outlook), wander};
}

HuntMission begin(const HuntPlan& plan) {
  HuntMission mission;
  mission.records.resize(plan.problem.targets.size());
  mission.tracks.resize(plan.problem.targets.size());
  mission.learned.assign(plan.problem.targets.size(), 0);
  mission.map = plan.map;
  return mission;
}

std::optional<Command> step(HuntMission& mission, const Observation& seen, const HuntPlan& plan) {
  look(mission, seen, plan.options);
  hear(mission, seen);
  const bool over = std::none_of(mission.records.begin(), mission.records.end(),
                                 [](const TargetRecord& r) { return r.status == TargetStatus::waiting; });
  if (over) return std::nullopt;
  if (std::exchange(mission.aimed, false)) {
    mission.fired = true;
    TargetRecord& record = mission.records[mission.prey];
    ++record.shots;
    return Fire{mission.prey, record.shot->shot};
  }
  if (seen.time_s - mission.last_hit_s > plan.options.patience_s) {
    give_up(mission, seen.time_s, plan.options);
    return std::nullopt;
  }
  const Rng rng = Rng(0).child("futures").child(mission.steps++);
  if (const auto led = likely_shot(mission, seen, plan, rng.child("shot"))) {
    TargetRecord& record = mission.records[mission.prey];
    record.shot = led->planned;
    record.pose = seen.pose;
    mission.aimed = true;
    return AimGun{led->planned.shot.yaw_rad, led->planned.shot.pitch_rad};
  }
  const std::size_t stop = best_stop(mission, seen, plan, rng.child("stop"));
  if (stop != mission.stop) {
    auto way = plan.outlook.routes.waypoints(mission.stop, stop);
    if (way.size() > 1) {
      way.front() = seen.pose.position;
      mission.stop = stop;
      return FollowWaypoints{std::move(way)};
    }
  }
  return Wait{(std::floor(seen.time_s / plan.options.look_s) + 1.0) * plan.options.look_s};
}

}  // namespace outrider
