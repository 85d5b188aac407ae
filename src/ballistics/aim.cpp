#include "outrider/ballistics/aim.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "outrider/ballistics/sight.hpp"
#include "outrider/ballistics/stance.hpp"

namespace outrider {
namespace {

constexpr double close_m = 1e-6;
constexpr int most_steps = 20;
constexpr double hopeless = 2.0;  // times the maximum speed of the gun: a search that reaches it is abandoned

/// The position of a ball and its velocity through the air, with their derivatives by speed, yaw and pitch.
struct State {
  std::array<Vec3, 4> place;
  std::array<Vec3, 4> u;
};

using Change = std::array<Vec3, 4>;

Change moved(const Change& from, double h, const Change& rate) {
  Change to;
  for (std::size_t i = 0; i < 4; ++i) to[i] = from[i] + h * rate[i];
  return to;
}

/// Returns the rate of change of the velocity through the air (the law) and of its derivatives.
Change rate_of(const Change& u, const Air& air, double gravity) {
  const double speed = norm(u[0]);
  const double k = -air.drag_per_m * speed;
  Change rate{Vec3{k * u[0].x, k * u[0].y, k * u[0].z - gravity}, {}, {}, {}};
  if (speed == 0.0) return rate;
  for (std::size_t i = 1; i < 4; ++i) {
    rate[i] = -air.drag_per_m * (speed * u[i] + dot(u[0], u[i]) / speed * u[0]);
  }
  return rate;
}

/// Makes one step. Positions are relative to the wind, so the velocity through the air is their rate of
/// change.
State runge_kutta(const State& state, const Air& air, double gravity, double h) {
  const Change& u1 = state.u;
  const Change a1 = rate_of(u1, air, gravity);
  const Change u2 = moved(u1, 0.5 * h, a1);
  const Change a2 = rate_of(u2, air, gravity);
  const Change u3 = moved(u1, 0.5 * h, a2);
  const Change a3 = rate_of(u3, air, gravity);
  const Change u4 = moved(u1, h, a3);
  const Change a4 = rate_of(u4, air, gravity);
  const auto sum = [h](const Change& from, const Change& k1, const Change& k2, const Change& k3,
                       const Change& k4) {
    return moved(moved(moved(moved(from, h / 6.0, k1), h / 3.0, k2), h / 3.0, k3), h / 6.0, k4);
  };
  return {sum(state.place, u1, u2, u3, u4), sum(u1, a1, a2, a3, a4)};
}

/// Returns the muzzle and its derivatives by speed, yaw and pitch.
std::array<Vec3, 4> muzzle_change(const ShotRules& rules, const Stance& stance, Vec2 position,
                                  const Shot& shot) {
  const auto at = [&](double yaw_rad, double pitch_rad) {
    return muzzle(rules.gun, stance, position, angles_of(stance, {yaw_rad, pitch_rad, 0.0}));
  };
  const double yaw = shot.yaw_rad, pitch = shot.pitch_rad;
  if (!stance.level()) {
    constexpr double step = 1e-5;
    return {at(yaw, pitch),
            {},
            0.5 / step * (at(yaw + step, pitch) - at(yaw - step, pitch)),
            0.5 / step * (at(yaw, pitch + step) - at(yaw, pitch - step))};
  }
  const Vec2 along = direction(yaw);
  const Vec2 aside = perpendicular(along);
  const Vec2 tip = muzzle(rules.gun, pitch);
  const double back = rules.gun.pivot_height_m - tip.y;  // d tip.x / d pitch
  return {
      at(yaw, pitch), {}, {tip.x * aside.x, tip.x * aside.y, 0.0}, {back * along.x, back * along.y, tip.x}};
}

/// Returns the state at the muzzle.
State start(const ShotRules& rules, const Platform& from, const Shot& shot) {
  const Stance stance = stance_at(rules, from.position);
  const Flight flight = launch(rules.gun, stance, from.position, shot, rules.gravity_mps2);
  const Vec2 along = direction(shot.yaw_rad);
  const Vec2 aside = perpendicular(along);
  const double c = std::cos(shot.pitch_rad);
  const double s = std::sin(shot.pitch_rad);
  const double v = shot.speed_mps;
  return {muzzle_change(rules, stance, from.position, shot),
          {flight.velocity_mps + from.velocity() - rules.air.wind(),
           {c * along.x, c * along.y, s},
           {v * c * aside.x, v * c * aside.y, 0.0},
           {-v * s * along.x, -v * s * along.y, v * c}}};
}

/// Returns the parabola of a robot at rest, or the fastest straight shot if there is none.
Aimed first_guess(const ShotRules& rules, const Platform& from, double pitch, Vec3 point) {
  const Vec2 sight = xy(point) - from.position;
  const Vec2 tip = muzzle(rules.gun, pitch);
  const double s = std::max(0.01, norm(sight) - tip.x);
  const double drop = stance_at(rules, from.position).ground_z_m + tip.y + s * std::tan(pitch) - point.z;
  const double most = 1.5 * rules.gun.muzzle_speed_mps;
  const double speed = drop > 0.0 ? std::sqrt(0.5 * rules.gravity_mps2 / drop) * s / std::cos(pitch) : most;
  const double capped = std::min(speed, most);
  return {{heading_of(sight), pitch, capped}, s / (capped * std::cos(pitch)), {}};
}

/// Solves x.x a + x.y b + x.z c = r; returns nothing if a, b and c are coplanar.
std::optional<Vec3> solve(Vec3 a, Vec3 b, Vec3 c, Vec3 r) {
  const double volume = dot(a, cross(b, c));
  if (volume == 0.0 || !std::isfinite(volume)) return std::nullopt;
  return 1.0 / volume * Vec3{dot(r, cross(b, c)), dot(a, cross(r, c)), dot(a, cross(b, r))};
}

}  // namespace

Arrival arrival(const ShotRules& rules, const Platform& from, const Shot& shot, double time_s) {
  State state = start(rules, from, shot);
  // Without air the path is a polynomial of degree 2, which one step gives exactly.
  const double rate = 20.0 + 8.0 * rules.air.drag_per_m * norm(state.u[0]);
  const int steps = rules.air.none() ? 1 : static_cast<int>(std::clamp(std::ceil(time_s * rate), 1.0, 1e4));
  for (int i = 0; i < steps; ++i) state = runge_kutta(state, rules.air, rules.gravity_mps2, time_s / steps);
  const Vec3 wind = rules.air.wind();
  return {state.place[0] + time_s * wind, state.u[0] + wind, state.place[1], state.place[2], state.place[3]};
}

std::optional<Aimed> aim_through(const ShotRules& rules, const Platform& from, double pitch_rad, Vec3 point,
                                 const Aimed* guess) {
  Aimed aimed = guess != nullptr ? *guess : first_guess(rules, from, pitch_rad, point);
  aimed.shot.pitch_rad = pitch_rad;
  for (int i = 0; i < most_steps; ++i) {
    aimed.at = arrival(rules, from, aimed.shot, aimed.flight_s);
    const Vec3 off = point - aimed.at.position;
    if (squared_norm(off) <= close_m * close_m) {
      aimed.shot.yaw_rad = wrap_angle(aimed.shot.yaw_rad);
      if (aimed.shot.speed_mps > rules.gun.muzzle_speed_mps) return std::nullopt;
      return aimed;
    }
    const auto change = solve(aimed.at.by_speed, aimed.at.by_yaw, aimed.at.velocity_mps, off);
    if (!change) return std::nullopt;
    // A step changes a value by at most a factor of 2, and the yaw by at most 0.5 rad.
    const auto bounded = [](double value, double by) { return value + std::clamp(by, -0.5 * value, value); };
    aimed.shot.speed_mps = bounded(aimed.shot.speed_mps, change->x);
    if (aimed.shot.speed_mps > hopeless * rules.gun.muzzle_speed_mps) return std::nullopt;
    aimed.shot.yaw_rad += std::clamp(change->y, -0.5, 0.5);
    aimed.flight_s = bounded(aimed.flight_s, change->z);
  }
  return std::nullopt;
}

double error_ratio(const ShotRules& rules, const Target& target, const Aimed& aimed) {
  const Arrival& at = aimed.at;
  const Vec2 velocity = xy(at.velocity_mps);
  const Vec2 along = 1.0 / norm(velocity) * velocity;
  const double slope = at.velocity_mps.z / norm(velocity);
  const Outline half = outline(target, direction(target.yaw_rad), along);
  // In the vertical plane across the path of the ball.
  const auto vertical = [&](Vec3 change) { return std::abs(change.z - slope * dot(along, xy(change))); };
  const auto lateral = [&](Vec3 change) { return std::abs(cross(along, xy(change))); };
  const double speed_error = rules.errors.speed_ratio * aimed.shot.speed_mps;
  const auto sum = [&](const auto& part) {
    return rules.errors.gun_rad * (part(at.by_yaw) + part(at.by_pitch)) + speed_error * part(at.by_speed);
  };
  const double ball = rules.gun.ball_radius_m;
  return std::max(sum(vertical) / (0.5 * target.size.z + half.along_m * std::abs(slope) + ball),
                  sum(lateral) / (half.across_m + ball));
}

}  // namespace outrider
