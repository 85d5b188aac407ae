#include "outrider/ballistics/shot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace outrider {
namespace {

constexpr double forgiving = 0.7;  // largest spread of a shot chosen for its time
constexpr double fine_pitch_rad = radians(0.5);
constexpr std::size_t most_flown = 48;  // candidates flown exactly before the best so far is taken

/// Half of the target's size along and across a direction of sight.
struct Outline {
  double along_m;
  double across_m;
};

Outline outline(const Target& target, double yaw_rad) {
  const double c = std::abs(std::cos(yaw_rad - target.yaw_rad));
  const double s = std::abs(std::sin(yaw_rad - target.yaw_rad));
  const double length = 0.5 * target.size.x;
  const double width = 0.5 * target.size.y;
  constexpr double tiny = 1e-9;
  return {std::min(length / std::max(c, tiny), width / std::max(s, tiny)), length * s + width * c};
}

struct Candidate {
  Shot shot;
  double spread;
  double time_s;  ///< to raise the barrel and to fly
};

bool better(const Candidate& a, const Candidate& b) {
  const bool a_forgives = a.spread <= forgiving;
  const bool b_forgives = b.spread <= forgiving;
  if (a_forgives != b_forgives) return a_forgives;
  return a_forgives ? a.time_s < b.time_s : a.spread < b.spread;
}

/// Every shot of the fine lattice that passes one of the aim points, the best first.
std::vector<Candidate> candidates(const ShotRules& rules, const Target& target, Vec2 position,
                                  double pitch_rad) {
  std::vector<Candidate> result;
  const Vec3 centre = target.centre();
  const Vec2 sight = xy(centre) - position;
  const double range = norm(sight);
  if (range == 0.0) return result;
  const double half_across = outline(target, heading_of(sight)).across_m;
  const int steps = static_cast<int>((rules.gun.pitch_high_rad - rules.gun.pitch_low_rad) / fine_pitch_rad);
  for (const double across : {0.0, 0.4, -0.4, 0.8, -0.8}) {
    const Vec2 aim = sight + across * half_across / range * perpendicular(sight);
    for (const double up : {0.0, 0.4, -0.4, 0.8}) {
      const double height = centre.z + up * 0.5 * target.size.z - rules.floor_z_m;
      const double off_centre = std::abs(across) + std::abs(up);
      for (int i = 0; i <= steps; ++i) {
        const double pitch = rules.gun.pitch_low_rad + i * fine_pitch_rad;
        const auto speed = speed_through(rules.gun, pitch, norm(aim), height, rules.gravity_mps2);
        if (!speed) continue;
        const Shot shot{heading_of(aim), pitch, *speed};
        const double flight = (norm(aim) - muzzle(rules.gun, pitch).x) / (*speed * std::cos(pitch));
        result.push_back({shot, spread(rules, target, position, shot) + off_centre,
                          flight + aim_time(rules.gun, 0.0, pitch - pitch_rad)});
      }
    }
  }
  std::stable_sort(result.begin(), result.end(), better);
  return result;
}

bool survives_errors(const ShotRules& rules, const FlightSpace& space, const Target& target, Vec2 position,
                     const Shot& shot) {
  for (unsigned corner = 0; corner < 8; ++corner) {
    const auto sign = [corner](unsigned bit) { return (corner >> bit & 1U) != 0 ? 1.0 : -1.0; };
    const Shot off{shot.yaw_rad + sign(0) * rules.errors.gun_rad,
                   shot.pitch_rad + sign(1) * rules.errors.gun_rad,
                   shot.speed_mps * (1.0 + sign(2) * rules.errors.speed_ratio)};
    const Flight flight = launch(rules.gun, position, rules.floor_z_m, off, rules.gravity_mps2);
    if (!fly(flight, rules.gun.ball_radius_m, space, target, rules.floor_z_m).hit) return false;
  }
  return true;
}

/// The flight flown exactly: nothing when it misses or does not keep the margin.
std::optional<PlannedShot> flown(const ShotRules& rules, const FlightSpace& space, const Target& target,
                                 Vec2 position, const Candidate& candidate) {
  const Flight flight = launch(rules.gun, position, rules.floor_z_m, candidate.shot, rules.gravity_mps2);
  const double radius = rules.gun.ball_radius_m;
  const Impact impact = fly(flight, radius, space, target, rules.floor_z_m);
  if (!impact.hit || space.first_contact(flight, radius + rules.margin_m, impact.time_s)) return {};
  return PlannedShot{candidate.shot,   impact.time_s,
                     impact.position,  space.clearance(flight, radius, impact.time_s, 1.0).distance_m,
                     candidate.spread, false};
}

}  // namespace

bool clear_of(const ShotRules& rules, const Target& target, Vec2 position) {
  const Vec2 along = direction(target.yaw_rad);
  const Vec2 offset = position - xy(target.base);
  const Vec2 beyond{std::max(0.0, std::abs(dot(offset, along)) - 0.5 * target.size.x),
                    std::max(0.0, std::abs(cross(along, offset)) - 0.5 * target.size.y)};
  return norm(beyond) >= rules.standoff_m;
}

Impact fly(const Flight& flight, double ball_radius_m, const FlightSpace& space, const Target& target,
           double floor_z_m) {
  const double end = fall_time(flight, std::min(floor_z_m, target.base.z) - 1.0);
  const auto touch = contact_time(flight, ball_radius_m, solid_of(target), 0.0, end);
  const auto obstacle = space.first_contact(flight, ball_radius_m, touch.value_or(end));
  if (obstacle && (!touch || obstacle->time_s <= *touch)) {
    return {false, obstacle->time_s, obstacle->position, obstacle->solid};
  }
  if (touch) return {true, *touch, flight.position(*touch), {}};
  return {false, end, flight.position(end), {}};
}

double spread(const ShotRules& rules, const Target& target, Vec2 position, const Shot& shot) {
  const Outline half = outline(target, shot.yaw_rad);
  const double range = distance(position, xy(target.base));
  const double s = range - muzzle(rules.gun, shot.pitch_rad).x;
  const double cosine = std::cos(shot.pitch_rad);
  const double tangent = std::tan(shot.pitch_rad);
  const double k = rules.gravity_mps2 / (2.0 * shot.speed_mps * shot.speed_mps * cosine * cosine);
  const double slope = tangent - 2.0 * k * s;
  // z(s) = h + s tan p - k s^2: dz/dp = s / cos^2 p - 2 k s^2 tan p, dz/dv = 2 k s^2 / v.
  const double by_pitch = std::abs(s / (cosine * cosine) - 2.0 * k * s * s * tangent);
  const double vertical = by_pitch * rules.errors.gun_rad + 2.0 * k * s * s * rules.errors.speed_ratio;
  const double lateral = range * rules.errors.gun_rad;
  const double ball = rules.gun.ball_radius_m;
  return std::max(vertical / (0.5 * target.size.z + half.along_m * std::abs(slope) + ball),
                  lateral / (half.across_m + ball));
}

std::optional<PlannedShot> best_shot(const ShotRules& rules, const FlightSpace& space, const Target& target,
                                     Vec2 position, double pitch_rad) {
  if (!clear_of(rules, target, position)) return std::nullopt;
  std::optional<PlannedShot> best;
  std::size_t tried = 0;
  for (const Candidate& candidate : candidates(rules, target, position, pitch_rad)) {
    auto shot = flown(rules, space, target, position, candidate);
    if (!shot) continue;
    shot->survives = survives_errors(rules, space, target, position, shot->shot);
    if (shot->survives) return shot;
    if (!best) best = shot;
    if (++tried == most_flown) break;
  }
  return best;
}

}  // namespace outrider
