#include "outrider/ballistics/shot.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "outrider/ballistics/aim.hpp"
#include "outrider/ballistics/firing_region.hpp"
#include "outrider/ballistics/sight.hpp"
#include "outrider/ballistics/stance.hpp"

namespace outrider {
namespace {

constexpr double forgiving = 0.7;  // largest error_ratio of a shot chosen for its time
constexpr double fine_pitch_rad = radians(0.5);
constexpr std::size_t most_rated = 4;         // number of shots whose hit rate is computed if none survives
constexpr std::size_t most_off_centre = 200;  // candidates simulated if a shot at the centre keeps the margin
constexpr std::size_t most_flown = 48;        // shots that keep the margin only, before the search stops

struct Candidate {
  Shot shot;
  double error_ratio;
  double time_s;  ///< time to pitch the barrel plus flight time
};

bool better(const Candidate& a, const Candidate& b) {
  const bool a_forgives = a.error_ratio <= forgiving;
  const bool b_forgives = b.error_ratio <= forgiving;
  if (a_forgives != b_forgives) return a_forgives;
  return a_forgives ? a.time_s < b.time_s : a.error_ratio < b.error_ratio;
}

/// A point on a target, seen from the gun.
struct Aim {
  Vec2 sight;             ///< vector from the yaw axis
  double height_m = 0.0;  ///< above the floor
  double off_centre;      ///< distance from the centre, relative to half the width and height
};

Aim centre_aim(const ShotRules& rules, const Target& target, Vec2 position) {
  return {xy(target.base) - position, target.centre().z - rules.floor_z_m, 0.0};
}

/// Returns a few aim points around the centre.
std::vector<Aim> central_aims(const ShotRules& rules, const Target& target, Vec2 position) {
  const Aim centre = centre_aim(rules, target, position);
  const Vec2 aside = 1.0 / norm(centre.sight) * perpendicular(centre.sight);
  const double half_across =
      outline(target, direction(target.yaw_rad), 1.0 / norm(centre.sight) * centre.sight).across_m;
  std::vector<Aim> aims;
  for (const double across : {0.0, 0.4, -0.4, 0.8, -0.8}) {
    for (const double up : {0.0, 0.4, -0.4, 0.8}) {
      if (across == 0.0 && up == 0.0) continue;
      aims.push_back({centre.sight + across * half_across * aside, centre.height_m + up * 0.5 * target.size.z,
                      std::abs(across) + std::abs(up)});
    }
  }
  return aims;
}

/// Returns all aim points of exhaust().
std::vector<Aim> all_aims(const ShotRules& rules, const Target& target, Vec2 position) {
  const Vec2 sight = xy(target.base) - position;
  const double half_across = outline(target, direction(target.yaw_rad), 1.0 / norm(sight) * sight).across_m;
  const double half_height = 0.5 * target.size.z;
  std::vector<Aim> aims;
  for (const Vec2 point : aim_points(target, position, rules.aim_step_m)) {
    const Vec2 aim = point - position;
    const double across = std::abs(cross(sight, aim)) / (norm(sight) * half_across);
    for (const double up : offsets(-half_height, half_height, rules.aim_step_m)) {
      aims.push_back({aim, target.centre().z + up - rules.floor_z_m, across + std::abs(up) / half_height});
    }
  }
  return aims;
}

/// Returns the shot at a pitch that passes the aim point.
std::optional<Candidate> candidate(const ShotRules& rules, const Target& target, Vec2 position, double pitch,
                                   const Aim& aim) {
  const double range = norm(aim.sight);
  const auto speed = speed_through(rules.gun, pitch, range, aim.height_m, rules.gravity_mps2);
  if (!speed) return std::nullopt;
  const Shot shot{heading_of(aim.sight), pitch, *speed};
  const double flight = (range - muzzle(rules.gun, pitch).x) / (*speed * std::cos(pitch));
  return Candidate{shot, error_ratio(rules, target, position, shot), flight};
}

/// Does the same on a slope.
std::optional<Candidate> candidate_leaning(const ShotRules& rules, const Stance& stance, const Target& target,
                                           Vec2 position, double pitch, const Aim& aim) {
  const auto line = line_of_fire(rules, stance, position, position + aim.sight, pitch);
  if (!line) return std::nullopt;
  const Elevation& at = line->at;
  const Vec2 sight = position + aim.sight - line->from;
  const double s = norm(sight) - at.tip.x;
  const double drop = (at.tip.y + s * at.tangent - aim.height_m) / (s * s);
  if (drop <= 0.0 || drop < at.least_drop) return std::nullopt;
  const double forward = std::sqrt(rules.gravity_mps2 / (2.0 * drop));
  const Vec2 along = 1.0 / norm(sight) * sight;
  return Candidate{
      {heading_of(sight), at.pitch_rad, forward / at.cosine},
      error_ratio(rules, target, outline(target, direction(target.yaw_rad), along), norm(sight), at, drop),
      s / forward};
}

/// Does the same in air; `last` is the shot at the previous pitch.
std::optional<Candidate> candidate_in_air(const ShotRules& rules, const Target& target, Vec2 position,
                                          double pitch, const Aim& aim, std::optional<Aimed>& last) {
  const Vec2 ground = position + aim.sight;
  last = aim_through(rules, {position, {}}, pitch, {ground.x, ground.y, aim.height_m + rules.floor_z_m},
                     last ? &*last : nullptr);
  if (!last) return std::nullopt;
  return Candidate{last->shot, error_ratio(rules, target, *last), last->flight_s};
}

/// Returns every shot at one of the pitches that passes one of the aim points, the best first.
std::vector<Candidate> candidates(const ShotRules& rules, const Target& target, Vec2 position,
                                  double pitch_rad, const std::vector<Aim>& aims) {
  const auto pitches = pitch_lattice(rules);
  const Stance stance = stance_at(rules, position);
  std::vector<Candidate> result;
  for (const Aim& aim : aims) {
    std::optional<Aimed> last;
    for (const double pitch : pitches) {
      auto found = !rules.air.none() ? candidate_in_air(rules, target, position, pitch, aim, last)
                   : !stance.level() ? candidate_leaning(rules, stance, target, position, pitch, aim)
                                     : candidate(rules, target, position, pitch, aim);
      if (!found) continue;
      found->error_ratio += aim.off_centre;
      found->time_s += aim_time(rules.gun, 0.0, pitch - pitch_rad);
      result.push_back(*found);
    }
  }
  std::stable_sort(result.begin(), result.end(), better);
  return result;
}

/// Returns true if the shot hits with errors that are these fractions of the largest errors.
bool hits_with_errors(const ShotRules& rules, const FlightSpace& space, const Target& target, Vec2 position,
                      const Shot& shot, double yaw_part, double pitch_part, double speed_part) {
  Shot off = off_by(stance_at(rules, position), shot, yaw_part * rules.errors.gun_rad,
                    pitch_part * rules.errors.gun_rad);
  off.speed_mps = shot.speed_mps * (1.0 + speed_part * rules.errors.speed_ratio);
  const Flight flight = launch(rules, {position, {}}, target, off);
  return fly(flight, rules.gun.ball_radius_m, space, target, rules.floor_z_m).hit;
}

bool survives_errors(const ShotRules& rules, const FlightSpace& space, const Target& target, Vec2 position,
                     const Shot& shot) {
  for (unsigned corner = 0; corner < 8; ++corner) {
    const auto sign = [corner](unsigned bit) { return (corner >> bit & 1U) != 0 ? 1.0 : -1.0; };
    if (!hits_with_errors(rules, space, target, position, shot, sign(0), sign(1), sign(2))) return false;
  }
  return true;
}

double hit_rate(const ShotRules& rules, const FlightSpace& space, const Target& target, Vec2 position,
                const Shot& shot) {
  constexpr std::array<double, 3> parts = {-2.0 / 3.0, 0.0, 2.0 / 3.0};
  int hits = 0;
  for (const double yaw : parts) {
    for (const double pitch : parts) {
      for (const double speed : parts) {
        hits += hits_with_errors(rules, space, target, position, shot, yaw, pitch, speed) ? 1 : 0;
      }
    }
  }
  return hits / 27.0;
}

/// Simulates the flight exactly; returns nothing if it misses or does not keep the margin.
std::optional<PlannedShot> flown(const ShotRules& rules, const FlightSpace& space, const Target& target,
                                 Vec2 position, const Candidate& candidate) {
  const Flight flight = launch(rules, {position, {}}, target, candidate.shot);
  const double radius = rules.gun.ball_radius_m;
  const double end = fall_time(flight, target.base.z - 1.0);
  const auto touch = contact_time(flight, radius, solid_of(target), 0.0, end);
  if (!touch || space.first_contact(flight, radius + rules.margin_m, *touch)) return {};
  return PlannedShot{candidate.shot,
                     angles_of(stance_at(rules, position), candidate.shot),
                     *touch,
                     flight.position(*touch),
                     0.0,
                     candidate.error_ratio,
                     false,
                     0.0};
}

/// Returns the first shot that survives all extreme errors; otherwise, of the first few that keep the margin,
/// the one with the highest hit rate.
std::optional<PlannedShot> first_to_fly(const ShotRules& rules, const FlightSpace& space,
                                        const Target& target, Vec2 position,
                                        const std::vector<Candidate>& shots, std::size_t most_tried) {
  std::optional<PlannedShot> best;
  std::size_t tried = 0;
  for (std::size_t i = 0; i < std::min(shots.size(), most_tried); ++i) {
    auto shot = flown(rules, space, target, position, shots[i]);
    if (!shot) continue;
    shot->survives = survives_errors(rules, space, target, position, shot->shot);
    if (shot->survives || tried < most_rated) {
      shot->hit_rate = shot->survives ? 1.0 : hit_rate(rules, space, target, position, shot->shot);
      if (!best || shot->hit_rate > best->hit_rate || shot->survives) best = shot;
    }
    if (shot->survives || ++tried == most_flown) break;
  }
  if (best) {
    const Flight flight = launch(rules, {position, {}}, target, best->shot);
    best->clearance_m = space.clearance(flight, rules.gun.ball_radius_m, best->flight_s, 1.0).distance_m;
  }
  return best;
}

}  // namespace

Flight launch(const ShotRules& rules, const Platform& from, const Target& target, const Shot& shot,
              double accuracy) {
  Flight flight = launch(rules.gun, stance_at(rules, from.position), from.position, shot, rules.gravity_mps2);
  flight.velocity_mps = flight.velocity_mps + from.velocity();
  if (rules.air.none()) return flight;
  const double lowest = std::min(rules.floor_z_m, target.base.z) - 1.0;
  flight.in_air = std::make_shared<const AirTrack>(rules.air, flight.muzzle, flight.velocity_mps,
                                                   flight.gravity_mps2, lowest, accuracy);
  return flight;
}

bool clear_of(const ShotRules& rules, const Target& target, Vec2 position) {
  const Vec2 offset = position - xy(target.base);
  if (norm(offset) >= rules.standoff_m + 0.5 * std::hypot(target.size.x, target.size.y)) return true;
  const Vec2 along = direction(target.yaw_rad);
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

double error_ratio(const ShotRules& rules, const Target& target, Vec2 position, const Shot& shot) {
  const Elevation at = elevation(rules, shot.pitch_rad);
  const double forward = shot.speed_mps * at.cosine;
  return error_ratio(rules, target, outline(target, direction(target.yaw_rad), direction(shot.yaw_rad)),
                     distance(position, xy(target.base)), at, rules.gravity_mps2 / (2.0 * forward * forward));
}

std::optional<PlannedShot> best_shot(const ShotRules& given, const FlightSpace& space, const Target& target,
                                     Vec2 position, double pitch_rad) {
  if (!clear_of(given, target, position) || position == xy(target.base)) return std::nullopt;
  ShotRules rules = given;
  rules.floor_z_m = stance_at(given, position).ground_z_m;
  ShotRules fine = rules;
  fine.pitch_step_rad = fine_pitch_rad;
  const auto best_at = [&](const ShotRules& lattice, const std::vector<Aim>& aims, std::size_t most_tried) {
    return first_to_fly(rules, space, target, position,
                        candidates(lattice, target, position, pitch_rad, aims), most_tried);
  };
  constexpr std::size_t all = std::numeric_limits<std::size_t>::max();
  auto best = best_at(fine, {centre_aim(rules, target, position)}, all);
  if (best && best->survives) return best;
  auto off_centre = best_at(fine, central_aims(rules, target, position), best ? most_off_centre : all);
  if (off_centre && (!best || off_centre->hit_rate > best->hit_rate)) best = off_centre;
  return best ? best : best_at(rules, all_aims(rules, target, position), all);
}

}  // namespace outrider
