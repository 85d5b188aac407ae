#include "outrider/ballistics/moving_target.hpp"

#include <algorithm>
#include <cmath>

#include "outrider/ballistics/aim.hpp"

namespace outrider {
namespace {

constexpr int most_meeting_rounds = 300;

/// Returns the first contact while the target moves straight, between `from_s` and `until_s` of the flight.
std::optional<double> touch_on_piece(const Flight& flight, double ball_radius_m, const Target& target,
                                     const Walk& walk, double fired_s, double from_s, double until_s) {
  const double span = until_s - from_s;
  const Vec2 begin = walk.at(fired_s + from_s);
  const Vec2 way = walk.at(fired_s + until_s) - begin;
  const Vec2 velocity = span > 0.0 ? 1.0 / span * way : Vec2{};
  for (double t = from_s;;) {
    const Solid box = solid_of(moved_to(target, begin + (t - from_s) * velocity));
    const double gap = distance(flight.position(t), box) - ball_radius_m;
    if (gap <= contact_tolerance_m) return t;
    const double speed = norm(flight.velocity(t) - Vec3{velocity.x, velocity.y, 0.0});
    t += 2.0 * gap / (speed + std::sqrt(speed * speed + 2.0 * flight.most_acceleration() * gap));
    if (t > until_s) return std::nullopt;
  }
}

std::optional<double> touch(const Flight& flight, double ball_radius_m, const Target& target,
                            const Walk& walk, double fired_s, double until_s) {
  double from_s = 0.0;
  for (const Walk::Knot& knot : walk.knots) {
    const double end_s = std::min(knot.time_s - fired_s, until_s);
    if (end_s <= from_s) continue;
    if (const auto t = touch_on_piece(flight, ball_radius_m, target, walk, fired_s, from_s, end_s)) return t;
    from_s = end_s;
  }
  return touch_on_piece(flight, ball_radius_m, target, walk, fired_s, from_s, until_s);
}

/// A shot at a pitch that meets the walk, with the time from now until it does.
struct Meeting {
  Shot shot;
  double aiming_s = 0.0;
  double flight_s = 0.0;
};

/// Returns the shot at a pitch through a place at the height of the target's centre, with its flight time.
std::optional<Aimed> shot_through(const ShotRules& rules, const Target& target, Vec2 place, Vec2 position,
                                  double pitch_rad, const std::optional<Aimed>& last) {
  const double height_m = target.centre().z;
  if (!rules.air.none()) {
    return aim_through(rules, {position, {}}, pitch_rad, {place.x, place.y, height_m},
                       last ? &*last : nullptr);
  }
  const Vec2 sight = place - position;
  const double range_m = norm(sight);
  const auto speed =
      speed_through(rules.gun, pitch_rad, range_m, height_m - rules.floor_z_m, rules.gravity_mps2);
  if (!speed) return std::nullopt;
  const double tip_m = muzzle(rules.gun, pitch_rad).x;
  return Aimed{
      {heading_of(sight), pitch_rad, *speed}, (range_m - tip_m) / (*speed * std::cos(pitch_rad)), {}};
}

std::optional<Meeting> meeting(const ShotRules& rules, const Target& target, const Walk& walk, Vec2 position,
                               double yaw_rad, double pitch_rad, double now_s, double at_pitch_rad) {
  const double exact_s = rules.air.none() ? 1e-12 : 1e-7;  // in air shots are aimed to a micrometre
  Meeting found;
  std::optional<Aimed> aimed;
  for (int round = 0; round < most_meeting_rounds; ++round) {
    const double lead_s = found.aiming_s + found.flight_s;
    aimed = shot_through(rules, target, walk.at(now_s + lead_s), position, at_pitch_rad, aimed);
    if (!aimed) return std::nullopt;
    found.shot = aimed->shot;
    found.aiming_s = aim_time(rules.gun, wrap_angle(found.shot.yaw_rad - yaw_rad), at_pitch_rad - pitch_rad);
    found.flight_s = aimed->flight_s;
    if (std::abs(found.aiming_s + found.flight_s - lead_s) <= exact_s) return found;
  }
  return std::nullopt;
}

bool rests(const Walk& walk, double from_s, double until_s) {
  const Vec2 place = walk.at(from_s);
  return walk.at(until_s) == place &&
         std::all_of(walk.knots.begin(), walk.knots.end(), [&](const Walk::Knot& knot) {
           return knot.time_s < from_s || knot.time_s > until_s || knot.position == place;
         });
}

}  // namespace

Vec2 Walk::at(double time_s) const {
  const auto after = std::upper_bound(knots.begin(), knots.end(), time_s,
                                      [](double t, const Knot& knot) { return t < knot.time_s; });
  if (after == knots.begin()) return knots.front().position;
  if (after == knots.end()) return knots.back().position;
  const Knot& a = *(after - 1);
  const Knot& b = *after;
  return a.position + (time_s - a.time_s) / (b.time_s - a.time_s) * (b.position - a.position);
}

Target moved_to(const Target& target, Vec2 place) {
  Target moved = target;
  moved.base = {place.x, place.y, target.base.z};
  return moved;
}

Impact fly_at(const Flight& flight, double ball_radius_m, const FlightSpace& space, const Target& target,
              const Walk& walk, double fired_s, double floor_z_m) {
  const double end = fall_time(flight, std::min(floor_z_m, target.base.z) - 1.0);
  const auto hit = touch(flight, ball_radius_m, target, walk, fired_s, end);
  const auto obstacle = space.first_contact(flight, ball_radius_m, hit.value_or(end));
  if (obstacle && (!hit || obstacle->time_s <= *hit)) {
    return {false, obstacle->time_s, obstacle->position, obstacle->solid};
  }
  if (hit) return {true, *hit, flight.position(*hit), {}};
  return {false, end, flight.position(end), {}};
}

std::optional<LedShot> led_shot(const ShotRules& rules, const FlightSpace& space, const Target& target,
                                const Walk& walk, Vec2 position, double yaw_rad, double pitch_rad,
                                double now_s) {
  double lead_s = 0.0;
  LedShot led;
  for (int round = 0; round < 3; ++round) {
    const Target there = moved_to(target, walk.at(now_s + lead_s));
    const auto best = best_shot(rules, space, there, position, pitch_rad);
    if (!best) return std::nullopt;
    led.planned = *best;
    const double still_aiming_s =
        aim_time(rules.gun, wrap_angle(best->shot.yaw_rad - yaw_rad), best->shot.pitch_rad - pitch_rad);
    led.fires_s = now_s + still_aiming_s;
    led.meets_s = led.fires_s + best->flight_s;
    if (rests(walk, now_s, led.meets_s + 0.1)) return led;
    const auto met = meeting(rules, target, walk, position, yaw_rad, pitch_rad, now_s, best->shot.pitch_rad);
    if (!met) return std::nullopt;
    led.planned.shot = met->shot;
    led.fires_s = now_s + met->aiming_s;
    led.meets_s = led.fires_s + met->flight_s;
    lead_s = led.meets_s - now_s;
  }
  const Flight flight = launch(rules, {position, {}}, target, led.planned.shot);
  const Impact impact =
      fly_at(flight, rules.gun.ball_radius_m, space, target, walk, led.fires_s, rules.floor_z_m);
  if (!impact.hit) return std::nullopt;
  led.planned.flight_s = impact.time_s;
  led.planned.contact = impact.position;
  return led;
}

}  // namespace outrider
