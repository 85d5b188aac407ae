#include "outrider/jobs/guard/plan/passing.hpp"

#include <algorithm>
#include <array>

#include "outrider/ballistics/aim.hpp"
#include "outrider/ballistics/stance.hpp"

namespace outrider {
namespace {

constexpr double moment_s = 0.2;
constexpr double settle_s = 0.1;       // that the gun is in its place before a shot
constexpr double passing_ratio = 0.7;  // largest error_ratio
constexpr std::size_t most_flown = 4;  // shots tried at a moment

/// The time of a moment since the beginning of its leg.
double moment_after_s(std::size_t moment) { return static_cast<double>(moment + 1) * moment_s; }

/// Returns the places and speeds that the robot may have instead when it shoots, under the extreme errors of
/// the moment and the way.
std::vector<Platform> displaced_platforms(const GuardProblem& problem, const HeightField* terrain,
                                          const Straight& straight, bool last, double after_s) {
  std::vector<Vec2> ends{straight.to};
  const double off = problem.errors.position_m;
  if (last && off > 0.0) {
    ends.clear();
    for (const Vec2 corner : {Vec2{1, 1}, Vec2{1, -1}, Vec2{-1, 1}, Vec2{-1, -1}}) {
      ends.push_back(straight.to + off * corner);
    }
  }
  std::vector<Platform> platforms;
  for (const Vec2 end : ends) {
    for (const double late : {-problem.errors.timing_s, problem.errors.timing_s}) {
      platforms.push_back(platform_on(problem.robot, straight.from, end, after_s + late, terrain));
    }
  }
  return platforms;
}

Shot off_by_corner(const Stance& stance, const Shot& shot, const AimErrors& errors, unsigned corner) {
  const auto sign = [corner](unsigned bit) { return (corner >> bit & 1U) != 0 ? 1.0 : -1.0; };
  Shot off = off_by(stance, shot, sign(0) * errors.gun_rad, sign(1) * errors.gun_rad);
  off.speed_mps = shot.speed_mps * (1.0 + sign(2) * errors.speed_ratio);
  return off;
}

bool survives(const ShotRules& rules, const FlightSpace& space, const Target& target, const Shot& shot,
              const std::vector<Platform>& platforms) {
  for (const Platform& platform : platforms) {
    const Stance stance = stance_at(rules, platform.position);
    for (unsigned corner = 0; corner < 8; ++corner) {
      const Flight flight =
          launch(rules, platform, target, off_by_corner(stance, shot, rules.errors, corner));
      if (!fly(flight, rules.gun.ball_radius_m, space, target, rules.floor_z_m).hit) return false;
    }
  }
  return true;
}

struct PassingShot {
  Aimed aimed;
  double error_ratio = 0.0;
};

/// Returns true if the joints let the barrel point that way, on a slope too.
bool can_point(const ShotRules& rules, const Stance& stance, const Shot& shot) {
  const double pitch = angles_of(stance, shot).pitch_rad;
  return stance.level() || (pitch >= rules.gun.pitch_low_rad && pitch <= rules.gun.pitch_high_rad);
}

/// The first shots at the target's centre that forgive enough, from the lowest pitch up: a flatter one is
/// sooner there.
std::vector<PassingShot> candidates(const ShotRules& rules, const Target& target, const Platform& platform) {
  const Stance stance = stance_at(rules, platform.position);
  std::vector<PassingShot> found;
  std::optional<Aimed> before;
  for (const double pitch : pitch_lattice(rules)) {
    if (found.size() == most_flown) break;
    auto aimed = aim_through(rules, platform, pitch, target.centre(), before ? &*before : nullptr);
    if (!aimed && before) aimed = aim_through(rules, platform, pitch, target.centre());
    before = aimed;
    if (!aimed || !can_point(rules, stance, aimed->shot)) continue;
    const double off = error_ratio(rules, target, *aimed);
    if (off <= passing_ratio) found.push_back({*aimed, off});
  }
  return found;
}

/// The flight flown exactly: nothing when it misses or does not keep the margin.
std::optional<PlannedShot> flown(const ShotRules& rules, const FlightSpace& space, const Target& target,
                                 const Platform& platform, const PassingShot& candidate) {
  const Shot& shot = candidate.aimed.shot;
  const Flight flight = launch(rules, platform, target, shot);
  const double radius = rules.gun.ball_radius_m;
  const double end = fall_time(flight, target.base.z - 1.0);
  const auto touch = contact_time(flight, radius, solid_of(target), 0.0, end);
  if (!touch || space.first_contact(flight, radius + rules.margin_m, *touch)) return std::nullopt;
  return PlannedShot{shot,
                     angles_of(stance_at(rules, platform.position), shot),
                     *touch,
                     flight.position(*touch),
                     space.clearance(flight, radius, *touch, 1.0).distance_m,
                     candidate.error_ratio,
                     true,
                     1.0};
}

/// Returns the flattest shot at the target's centre, or nothing if there is none. Candidates are the pitches
/// of the lattice: the lowest four that reach the centre with an error_ratio of at most 0.7. A shot must keep
/// the margin, and hit under all combinations of extreme errors: of the gun, of the muzzle speed, of the
/// firing time and, on the last leg (`last`), of the place where the leg ends. Tried only where a standing
/// robot could hit the target.
std::optional<PlannedShot> passing_shot(const GuardProblem& problem, const FiringMap& firing_map,
                                        std::size_t target, const Straight& straight, bool last,
                                        double after_s) {
  const Target& aim = problem.targets[target];
  const HeightField* const terrain = firing_map.ground.terrain();
  const Platform platform = platform_on(problem.robot, straight.from, straight.to, after_s, terrain);
  const auto cell = firing_map.cell_of(platform.position);
  if (!cell || !clear_of(firing_map.rules, aim, platform.position) || !firing_map.has_shot(target, *cell))
    return std::nullopt;

  const FlightSpace& space = firing_map.space(target);
  const auto shot_with_errors = displaced_platforms(problem, terrain, straight, last, after_s);
  for (const PassingShot& candidate : candidates(firing_map.rules, aim, platform)) {
    const auto shot = flown(firing_map.rules, space, aim, platform, candidate);
    if (shot && survives(firing_map.rules, space, aim, shot->shot, shot_with_errors)) return shot;
  }
  return std::nullopt;
}

}  // namespace

Platform platform_on(const RobotModel& robot, Vec2 from, Vec2 to, double after_s,
                     const HeightField* terrain) {
  const double level_m = distance(from, to);
  if (level_m == 0.0) return {from, {}};
  const Vec2 along = 1.0 / level_m * (to - from);
  if (terrain == nullptr) {
    return {from + covered(level_m, robot.straight(), after_s) * along,
            speed_after(level_m, robot.straight(), after_s) * along};
  }
  const double length_m = terrain->length({from, to});
  const Vec2 at = terrain->walked({from, to}, covered(length_m, robot.straight(), after_s));
  const double speed = speed_after(length_m, robot.straight(), after_s);
  const double slope = dot(terrain->gradient(at), along);
  const Vec3 uphill{along.x, along.y, slope};
  const Vec3 velocity = speed / norm(uphill) * uphill;
  return {at, xy(velocity), velocity.z};
}

GunState joints_of(const FiringMap& firing_map, const Pose2& robot, const GunAngles& barrel) {
  const double ahead = heading_on(stance_at(firing_map.rules, robot.position), robot.heading_rad);
  return {wrap_angle(barrel.yaw_rad - ahead), barrel.pitch_rad};
}

double last_landing_s(const std::vector<PassingHit>& passing) {
  double last = 0.0;
  for (const PassingHit& hit : passing) last = std::max(last, hit.leaves_s + hit.shot.flight_s);
  return last;
}

GunState gun_after(const std::vector<PassingHit>& passing, GunState before) {
  return passing.empty() ? before : passing.back().gun;
}

/// Finds the targets that a robot could hit from rest at each moment, without solving a shot.
PassingShots::Leg PassingShots::look_along(const Straight& straight) const {
  const HeightField* const terrain = firing_map_.ground.terrain();
  Leg leg;
  for (std::size_t m = 0; moment_after_s(m) < straight.length_s; ++m) {
    std::vector<Chance>& chances = leg.moments.emplace_back();
    const Vec2 at =
        platform_on(problem_.robot, straight.from, straight.to, moment_after_s(m), terrain).position;
    const auto cell = firing_map_.cell_of(at);
    for (std::uint32_t target = 0; cell && target < problem_.targets.size(); ++target) {
      if (firing_map_.has_shot(target, *cell)) chances.push_back({target, unsolved});
    }
  }
  return leg;
}

PassingShots::Leg& PassingShots::leg_along(const Straight& straight, bool last) {
  const auto [entry, added] =
      legs_.try_emplace({straight.from.x, straight.from.y, straight.to.x, straight.to.y, last});
  if (added) entry->second = look_along(straight);
  return entry->second;
}

const PassingShots::LegShot* PassingShots::shot_of(Leg& leg, Chance& chance, const Straight& straight,
                                                   bool last, double after_s) const {
  if (chance.shot == unsolved) {
    const auto shot = passing_shot(problem_, firing_map_, chance.target, straight, last, after_s);
    chance.shot = shot ? static_cast<std::uint32_t>(leg.shots.size()) : no_shot;
    if (!shot) return nullptr;
    const HeightField* const terrain = firing_map_.ground.terrain();
    const Vec2 at = platform_on(problem_.robot, straight.from, straight.to, after_s, terrain).position;
    const Pose2 robot{at, heading_of(straight.to - straight.from)};
    leg.shots.push_back({*shot, joints_of(firing_map_, robot, shot->gun)});
  }
  return chance.shot == no_shot ? nullptr : &leg.shots[chance.shot];
}

/// Fires at the target whose region the robot leaves first, of those that can be hit now with the gun in
/// time.
void PassingShots::fire(Salvo& salvo, Leg& leg, std::size_t moment, const Straight& straight, bool last) {
  const double after_s = moment_after_s(moment), leaves_s = straight.begin_s + after_s;
  if (salvo.ready_s > leaves_s) return;
  std::vector<Chance*> now;
  for (Chance& chance : leg.moments[moment]) {
    if (salvo.wanted[chance.target]) now.push_back(&chance);
  }
  std::ranges::stable_sort(now, {}, [&](const Chance* chance) { return salvo.last_s[chance->target]; });
  for (Chance* chance : now) {
    const LegShot* const shot = shot_of(leg, *chance, straight, last, after_s);
    if (shot == nullptr) continue;
    const double aim_s = aim_time(problem_.gun, shot->gun.yaw_rad - salvo.gun.yaw_rad,
                                  shot->gun.pitch_rad - salvo.gun.pitch_rad);
    if (salvo.ready_s + aim_s > leaves_s) continue;
    salvo.chosen.push_back({chance->target, straight.leg, after_s, leaves_s, shot->shot, shot->gun});
    salvo.gun = shot->gun;
    salvo.ready_s = leaves_s + settle_s;
    salvo.wanted[chance->target] = false;
    return;
  }
}

std::vector<PassingHit> PassingShots::along(double heading_rad, const std::vector<Vec2>& waypoints,
                                            GunState gun, const std::vector<std::size_t>& targets) {
  const auto path = straights(problem_.robot, heading_rad, waypoints, firing_map_.ground.terrain());
  const std::size_t count = problem_.targets.size();
  Salvo salvo{gun, settle_s, std::vector<bool>(count), std::vector<double>(count), {}};
  for (const std::size_t target : targets) salvo.wanted[target] = true;
  std::vector<Leg*> legs;
  for (const Straight& straight : path) {
    Leg& leg = *legs.emplace_back(&leg_along(straight, &straight == &path.back()));
    for (std::size_t m = 0; m < leg.moments.size(); ++m) {
      for (const Chance& chance : leg.moments[m])
        salvo.last_s[chance.target] = straight.begin_s + moment_after_s(m);
    }
  }
  for (std::size_t j = 0; j < path.size(); ++j) {
    for (std::size_t m = 0; m < legs[j]->moments.size(); ++m)
      fire(salvo, *legs[j], m, path[j], j + 1 == path.size());
  }
  return salvo.chosen;
}

}  // namespace outrider
