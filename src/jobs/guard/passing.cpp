#include "outrider/jobs/guard/passing.hpp"

#include <algorithm>
#include <array>

#include "outrider/ballistics/aim.hpp"
#include "outrider/ballistics/stance.hpp"

namespace outrider {
namespace {

constexpr double moment_s = 0.2;
constexpr double settle_s = 0.1;       // that the gun is in its place before a shot
constexpr double passing_ratio = 0.7;  // largest error_ratio
constexpr std::size_t most_flown = 4;  // shots that a moment is given up after

/// Where the robot may be instead when it shoots, under the extreme errors of the moment and the way.
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

struct Candidate {
  Aimed aimed;
  double error_ratio = 0.0;
};

/// Whether the joints let the barrel point that way, on a slope too.
bool can_point(const ShotRules& rules, const Stance& stance, const Shot& shot) {
  const double pitch = angles_of(stance, shot).pitch_rad;
  return stance.level() || (pitch >= rules.gun.pitch_low_rad && pitch <= rules.gun.pitch_high_rad);
}

/// The shots at the target's centre that forgive enough, the soonest there first.
std::vector<Candidate> candidates(const ShotRules& rules, const Target& target, const Platform& platform) {
  const Stance stance = stance_at(rules, platform.position);
  std::vector<Candidate> found;
  std::optional<Aimed> before;
  for (const double pitch : pitch_lattice(rules)) {
    auto aimed = aim_through(rules, platform, pitch, target.centre(), before ? &*before : nullptr);
    if (!aimed && before) aimed = aim_through(rules, platform, pitch, target.centre());
    before = aimed;
    if (!aimed || !can_point(rules, stance, aimed->shot)) continue;
    const double off = error_ratio(rules, target, *aimed);
    if (off <= passing_ratio) found.push_back({*aimed, off});
  }
  std::stable_sort(found.begin(), found.end(), [](const Candidate& a, const Candidate& b) {
    return a.aimed.flight_s < b.aimed.flight_s;
  });
  return found;
}

/// The flight flown exactly: nothing when it misses or does not keep the margin.
std::optional<PlannedShot> flown(const ShotRules& rules, const FlightSpace& space, const Target& target,
                                 const Platform& platform, const Candidate& candidate) {
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

}  // namespace

std::vector<Straight> straights(const RobotModel& robot, double heading_rad,
                                const std::vector<Vec2>& waypoints, const HeightField* terrain) {
  std::vector<Straight> result;
  double time = 0.0;
  for (std::size_t i = 1; i < waypoints.size(); ++i) {
    const Vec2 leg = waypoints[i] - waypoints[i - 1];
    if (norm(leg) == 0.0) continue;
    time += duration(std::abs(wrap_angle(heading_of(leg) - heading_rad)), robot.turning());
    heading_rad = heading_of(leg);
    const double length_m =
        terrain != nullptr ? terrain->length({waypoints[i - 1], waypoints[i]}) : norm(leg);
    const double length_s = duration(length_m, robot.straight());
    result.push_back({i, waypoints[i - 1], waypoints[i], time, length_s});
    time += length_s;
  }
  return result;
}

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

std::optional<PlannedShot> passing_shot(const GuardProblem& problem, const FiringMap& firing_map,
                                        std::size_t target, const Straight& straight, bool last,
                                        double after_s) {
  const Target& aim = problem.targets[target];
  const HeightField* const terrain = firing_map.ground.terrain();
  const Platform platform = platform_on(problem.robot, straight.from, straight.to, after_s, terrain);
  const Cell cell = firing_map.frame.cell_at(platform.position);
  if (!firing_map.frame.contains(cell) || !clear_of(firing_map.rules, aim, platform.position))
    return std::nullopt;
  if (firing_map.regions[target].pitch[firing_map.frame.index(cell)] == FiringRegion::no_shot)
    return std::nullopt;

  const FlightSpace& space = firing_map.space(target);
  const auto shot_with_errors = displaced_platforms(problem, terrain, straight, last, after_s);
  const auto shots = candidates(firing_map.rules, aim, platform);
  for (std::size_t i = 0; i < std::min(shots.size(), most_flown); ++i) {
    const auto shot = flown(firing_map.rules, space, aim, platform, shots[i]);
    if (shot && survives(firing_map.rules, space, aim, shot->shot, shot_with_errors)) return shot;
  }
  return std::nullopt;
}

const std::vector<PassingShots::LegShot>& PassingShots::from_leg(const Straight& straight, bool last,
                                                                 std::size_t target) {
  const Leg leg{straight.from.x, straight.from.y, straight.to.x, straight.to.y, last, target};
  const auto [entry, added] = solved_.try_emplace(leg);
  for (int k = 1; added && k * moment_s < straight.length_s; ++k) {
    const auto shot = passing_shot(problem_, firing_map_, target, straight, last, k * moment_s);
    if (!shot) continue;
    const Vec2 at =
        platform_on(problem_.robot, straight.from, straight.to, k * moment_s, firing_map_.ground.terrain())
            .position;
    const Pose2 robot{at, heading_of(straight.to - straight.from)};
    entry->second.push_back({k, *shot, joints_of(firing_map_, robot, shot->gun)});
  }
  return entry->second;
}

PassingShots::Way& PassingShots::way_along(double heading_rad, const std::vector<Vec2>& waypoints) {
  std::vector<double> key{heading_rad};
  for (const Vec2 point : waypoints) key.insert(key.end(), {point.x, point.y});
  const auto [entry, added] = ways_.try_emplace(std::move(key));
  if (added) {
    entry->second = {straights(problem_.robot, heading_rad, waypoints, firing_map_.ground.terrain()), {}};
    entry->second.offers.resize(problem_.targets.size());
  }
  return entry->second;
}

const std::vector<PassingShots::Offer>& PassingShots::offers_on(Way& way, std::size_t target) {
  auto& offers = way.offers[target];
  if (offers) return *offers;
  offers.emplace();
  const auto& straights = way.straights;
  for (std::size_t j = 0; j < straights.size(); ++j) {
    for (const LegShot& shot : from_leg(straights[j], j + 1 == straights.size(), target))
      offers->push_back({j, straights[j].begin_s + shot.moment * moment_s, &shot});
  }
  return *offers;
}

std::vector<PassingHit> PassingShots::along(double heading_rad, const std::vector<Vec2>& waypoints,
                                            GunState gun, const std::vector<std::size_t>& targets) {
  Way& way = way_along(heading_rad, waypoints);
  std::vector<Offered> offered;
  for (const std::size_t target : targets) {
    const auto& offers = offers_on(way, target);
    if (!offers.empty()) offered.push_back({target, offers, offers.back().leaves_s});
  }
  std::vector<PassingHit> chosen;
  double free_s = 0.0;  // since when the gun may turn to the next shot
  for (std::size_t j = 0; j < way.straights.size() && !offered.empty(); ++j) {
    const Straight& straight = way.straights[j];
    const auto in_time = [&](const Offer& offer) {
      const GunState& to = offer.of->gun;
      return free_s + settle_s +
                 aim_time(problem_.gun, to.yaw_rad - gun.yaw_rad, to.pitch_rad - gun.pitch_rad) <=
             offer.leaves_s;
    };
    for (int k = 1; k * moment_s < straight.length_s; ++k) {
      Offered* urgent = nullptr;  // of the targets with an offer now, that whose last offer comes first
      const Offer* now = nullptr;
      for (Offered& one : offered) {
        if (one.left.empty() || one.left.front().straight != j || one.left.front().of->moment != k) continue;
        const Offer& offer = one.left.front();
        one.left = one.left.subspan(1);
        if (urgent != nullptr && urgent->last_s <= one.last_s) continue;
        if (in_time(offer)) urgent = &one, now = &offer;
      }
      if (urgent == nullptr) continue;
      chosen.push_back(
          {urgent->target, straight.leg, k * moment_s, now->leaves_s, now->of->shot, now->of->gun});
      gun = now->of->gun;
      free_s = now->leaves_s;
      urgent->left = {};
    }
  }
  return chosen;
}

}  // namespace outrider
