#include "outrider/jobs/guard/behaviour/moving_targets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "outrider/ballistics/sight.hpp"

namespace outrider {
namespace {

constexpr double coarse_track = 5e-5;     // accuracy of a flight in air: 1 mm after 1.5 s
constexpr std::size_t most_flights = 32;  // futures that a shot is flown at
constexpr std::size_t futures = 24;       // that a stop is judged by
constexpr double horizon_s = 60.0;        // of these
constexpr double flight_horizon_s = 10.0;
constexpr double worth_moving_s = 1.0;
constexpr double region_m = 1.1;  // a rest within this distance of a region is taken for one there
constexpr std::size_t no_region = std::numeric_limits<std::size_t>::max();

/// No shot at one who is on that walk meets it sooner. Over the ground a ball is never faster than it leaves
/// the gun or than the wind, as drag takes it from the one to the other.
double soonest_meeting_s(const ShotRules& rules, const Target& target, const Walk& walk, double speed_mps,
                         const Observation& seen) {
  const double nearest_m = distance(walk.at(seen.time_s), seen.odometry.position) -
                           std::hypot(rules.gun.tip_forward_m, rules.gun.tip_up_m) - rules.gun.ball_radius_m -
                           0.5 * std::hypot(target.size.x, target.size.y);
  const double ball_mps = rules.air.none() ? rules.gun.muzzle_speed_mps
                                           : std::max(rules.gun.muzzle_speed_mps, rules.air.wind_mps);
  constexpr double rounding_s = 1e-6;
  return seen.time_s + std::max(0.0, nearest_m) / (ball_mps + speed_mps) - rounding_s;
}

bool is_out_of_range(const MovingPlan& plan, std::size_t who, const Walk& walk, const Observation& seen) {
  return !plan.longest_m.empty() &&
         distance(walk.at(seen.time_s), seen.odometry.position) > plan.longest_m[who];
}

/// A rest to come: where, as a region, and when.
struct Rest {
  std::size_t region = no_region;
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

}  // namespace

Outcome<MovingPlan> plan_moving(const GuardProblem& problem, const FiringMap& firing_map, const VisitMap& map,
                                const GuardOptions& options, const WanderOptions& wander,
                                const Budget& budget) {
  GuardProblem regions = problem;
  regions.targets.clear();
  for (const Vec2 region : map.regions) {
    Target target = moved_to(problem.targets.front(), region);
    target.name = fmt::format("region_{}", regions.targets.size());
    target.base.z = firing_map.rules.floor_z_m;
    regions.targets.push_back(std::move(target));
  }
  GuardOptions coarse = options;
  // Stops need not be finer than that beside regions 1.5 m apart; in air each place takes far longer.
  coarse.resolution_m = std::max(options.resolution_m, problem.air.none() ? 0.2 : 0.3);
  // In air it takes long to prove that a region cannot be hit, and a stop is all that a proof could find.
  auto surveyed = build_firing_map(
      regions, coarse, budget, problem.air.none() ? RegionSearch::exhaustive : RegionSearch::centres_only);
  if (!surveyed) return pass_on(surveyed);
  GuardPlan none;
  none.on_the_move = options.shoot_on_the_move;
  auto precomputed = precompute_stops(regions, *surveyed, none, usual_stops, budget);
  if (!precomputed) return pass_on(precomputed);
  std::vector<double> longest_m;
  if (!problem.air.none()) {
    for (const Target& target : problem.targets) longest_m.push_back(longest_range(firing_map.rules, target));
  }
  return MovingPlan{problem, firing_map, map, std::move(*precomputed), wander, std::move(longest_m)};
}

MovingTargets::MovingTargets(const MovingPlan& plan)
    : plan_(&plan),
      tracks_(plan.problem.targets.size()),
      map_(plan.map),
      learned_(plan.problem.targets.size(), 0) {}

TaskBoard MovingTargets::board() const {
  return {plan_->problem, plan_->firing_map, plan_->problem.targets.size()};
}

bool MovingTargets::is_wanted(const TaskBoard& board, std::size_t who) const {
  return board.records()[who].status == TargetStatus::waiting && !tracks_[who].empty() &&
         !board.is_in_air(who);
}

void MovingTargets::note_seen(const Observation& seen) {
  const WanderOptions& options = plan_->options;
  for (const TargetObservation& one : seen.targets->seen) {
    tracks_[one.target].push_back({one.time_s, one.position});
  }
  if (!options.learn) return;
  // In pieces of a few looks, so that a rest is told from a step.
  constexpr std::size_t piece = 20;
  for (std::size_t who = 0; who < tracks_.size(); ++who) {
    const Track& track = tracks_[who];
    if (track.size() < learned_[who] + piece) continue;
    learn(map_, track, options, learned_[who]);
    learned_[who] = track.size() - 1;
  }
}

/// The part of the possible futures, under the errors of the gun, in which the shot hits; something below
/// `options.chance` as soon as that is certain to be too much.
double MovingTargets::chance_of(std::size_t who, const LedShot& led, Vec2 position, Rng rng) const {
  const MovingPlan& plan = *plan_;
  const ShotRules& rules = plan.firing_map.rules;
  const Stride stride = stride_of(tracks_[who], plan.options);
  std::size_t hits = 0;
  for (std::size_t i = 0; i < most_flights; ++i) {
    const Walk walk = possible_future(map_, stride, led.meets_s + 1.0, rng);
    Shot shot = led.planned.shot;
    shot.yaw_rad += rules.errors.gun_rad * rng.uniform(-1.0, 1.0);
    shot.pitch_rad += rules.errors.gun_rad * rng.uniform(-1.0, 1.0);
    shot.speed_mps *= 1.0 + rules.errors.speed_ratio * rng.uniform(-1.0, 1.0);
    const Flight flight = launch(rules, {position, {}}, plan.problem.targets[who], shot, coarse_track);
    hits += fly_at(flight, rules.gun.ball_radius_m, plan.firing_map.space(who), plan.problem.targets[who],
                   walk, led.fires_s, rules.floor_z_m)
                    .hit
                ? 1U
                : 0U;
    const double most = static_cast<double>(hits + most_flights - i - 1) / static_cast<double>(most_flights);
    if (most < plan.options.chance) return most;
  }
  return static_cast<double>(hits) / static_cast<double>(most_flights);
}

/// The soonest shot that is likely enough, if there is one.
std::optional<LedShot> MovingTargets::likely_shot(const TaskBoard& board, const Observation& seen,
                                                  const Rng& rng) {
  const MovingPlan& plan = *plan_;
  std::optional<LedShot> best;
  const double yaw_rad = wrap_angle(seen.odometry.heading_rad + seen.gun->yaw_rad);
  for (std::size_t who = 0; who < tracks_.size(); ++who) {
    if (!is_wanted(board, who)) continue;
    const Stride stride = stride_of(tracks_[who], plan.options);
    const Walk walk = straight_on(stride, seen.time_s + flight_horizon_s);
    const double soonest_s = soonest_meeting_s(plan.firing_map.rules, plan.problem.targets[who], walk,
                                               norm(stride.velocity_mps), seen);
    if (is_out_of_range(plan, who, walk, seen) || (best && best->meets_s <= soonest_s)) continue;
    const auto led = led_shot(plan.firing_map.rules, plan.firing_map.space(who), plan.problem.targets[who],
                              walk, seen.odometry.position, yaw_rad, seen.gun->pitch_rad, seen.time_s);
    if (!led || (best && best->meets_s <= led->meets_s)) continue;
    const double chance = chance_of(who, *led, seen.odometry.position, rng.child(who));
    if (chance < plan.options.chance) continue;
    best = led;
    aimed_at_ = who;
    chance_ = chance;
    expected_at_ = walk.at(led->meets_s);
  }
  return best;
}

/// The stop with the least expected time to a shot. Where the robot is nobody can be shot at now, or it would
/// be.
std::size_t MovingTargets::best_stop(const TaskBoard& board, const Observation& seen, const Rng& rng) const {
  const MovingPlan& plan = *plan_;
  std::vector<std::vector<Rest>> all(futures);  // by future, the rests of all targets
  for (std::size_t who = 0; who < tracks_.size(); ++who) {
    if (!is_wanted(board, who)) continue;
    const Stride stride = stride_of(tracks_[who], plan.options);
    Rng draws = rng.child(who);
    for (std::vector<Rest>& rests : all) {
      const auto own = rests_of(possible_future(map_, stride, seen.time_s + horizon_s, draws), map_.regions);
      rests.insert(rests.end(), own.begin(), own.end());
    }
  }
  const StopTable& precomputed = plan.stops;
  std::size_t best = stop_;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < precomputed.stops.size(); ++i) {
    const std::size_t stop = i == 0 ? stop_ : i == stop_ ? 0 : i;  // this one first
    std::vector<char> hit_from_here(map_.regions.size(), 0);
    for (const Service& service : precomputed.table.services[stop]) hit_from_here[service.goal] = 1;
    double there_s = seen.time_s + plan.options.look_s;
    if (stop != stop_) {
      const Drive drive = precomputed.routes.between(stop_, stop);
      if (!std::isfinite(drive.time_s)) continue;
      there_s = seen.time_s + drive.time_s +
                duration(std::abs(wrap_angle(drive.departure_rad - seen.odometry.heading_rad)),
                         plan.problem.robot.turning());
    }
    const double wait = expected_wait(hit_from_here, all, there_s, seen.time_s);
    if (wait < least - (best == stop_ && i > 0 ? worth_moving_s : 0.0)) {
      least = wait;
      best = stop;
    }
  }
  return best;
}

void MovingTargets::note(TaskBoard& board, const Observation& seen) {
  note_seen(seen);
  board.note_drive(seen);
  board.note_shots(seen, false);
}

std::optional<Command> MovingTargets::propose(TaskBoard& board, const Observation& seen) {
  const MovingPlan& plan = *plan_;
  double last_hit_s = 0.0;
  bool any_waits = false;
  for (const TargetRecord& record : board.records()) {
    any_waits = any_waits || record.status == TargetStatus::waiting;
    if (record.status == TargetStatus::reached) last_hit_s = std::max(last_hit_s, record.done_s);
  }
  if (!any_waits) return std::nullopt;
  if (std::exchange(aimed_, false)) {
    const PlannedShot& shot = *board.records()[aimed_at_].shot;
    const bool awaited = !plan.stops.on_the_move;
    board.launch({.target = aimed_at_,
                  .lands_s = seen.time_s + shot.flight_s,
                  .leaves_s = seen.time_s,
                  .awaited = awaited});
    return Fire{aimed_at_, shot.shot, awaited};
  }
  if (seen.time_s - last_hit_s > plan.options.patience_s) {
    board.fail_waiting(fmt::format("nobody was hit for {:g} s", plan.options.patience_s), seen.time_s);
    return std::nullopt;
  }
  const Rng rng = Rng(0).child("futures").child(steps_++);
  if (const auto led = likely_shot(board, seen, rng.child("shot"))) {
    board.aim_at(aimed_at_, led->planned, seen.odometry);
    aimed_ = true;
    expected_hits_ += chance_;
    return AimGun{led->planned.shot.yaw_rad, led->planned.shot.pitch_rad};
  }
  // A target that is missed may be hit from here.
  const std::size_t stop = board.any_in_air() ? stop_ : best_stop(board, seen, rng.child("stop"));
  if (board.is_elsewhere(seen)) {
    stop_ = stop;
    if (auto drive = board.drive_again(plan.stops.stops[stop], seen)) return drive;
  } else if (stop != stop_) {
    auto way = plan.stops.routes.waypoints(stop_, stop);
    if (way.size() > 1) {
      way.front() = seen.odometry.position;
      stop_ = stop;
      board.begin_drive(way.back());
      return FollowWaypoints{std::move(way)};
    }
  }
  // The next look is later, although the time of one may be rounded to less than its multiple.
  constexpr double instant_s = 1e-9;
  return Wait{(std::floor((seen.time_s + instant_s) / plan.options.look_s) + 1.0) * plan.options.look_s};
}

}  // namespace outrider
