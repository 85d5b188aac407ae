#include "outrider/ballistics/stance.hpp"

#include <algorithm>
#include <cmath>

namespace outrider {
namespace {

constexpr int most_yaw_rounds = 60;
constexpr double close = 1e-14;

Vec3 barrel(const GunAngles& angles) {
  const double c = std::cos(angles.pitch_rad);
  return {c * std::cos(angles.yaw_rad), c * std::sin(angles.yaw_rad), std::sin(angles.pitch_rad)};
}

/// Returns the yaw direction, in the frame of the ground, for which a barrel of that pitch lies in the
/// vertical plane through `along` and points that way.
std::optional<Vec2> yaw_towards(const Rotation& ground, Vec2 along, double tangent) {
  // across . (cos p cos y, cos p sin y, sin p) = 0
  const Vec3 across = ground.unrotate({-along.y, along.x, 0.0});
  const double sum = -across.z * tangent;
  const double square = squared_norm(xy(across));
  if (sum * sum > square) return std::nullopt;
  const double root = std::sqrt(square - sum * sum);
  const Vec2 yaw = 1.0 / square * Vec2{across.x * sum + across.y * root, across.y * sum - across.x * root};
  const Vec3 ahead = ground * Vec3{yaw.x, yaw.y, tangent};
  if (dot(xy(ahead), along) <= 0.0) return std::nullopt;
  return yaw;
}

}  // namespace

Stance stance_at(const ShotRules& rules, Vec2 position) {
  if (!rules.terrain) return {rules.floor_z_m, {0.0, 0.0, 1.0}};
  return {rules.terrain->height(position), rules.terrain->normal(position)};
}

Rotation leaning(Vec3 up) {
  const double k = 1.0 / (1.0 + up.z);
  return {{Vec3{1.0 - k * up.x * up.x, -k * up.x * up.y, -up.x},
           Vec3{-k * up.x * up.y, 1.0 - k * up.y * up.y, -up.y}, up}};
}

GunAngles angles_of(const Stance& stance, const Shot& shot) {
  if (stance.level()) return {shot.yaw_rad, shot.pitch_rad};
  const Vec3 d = leaning(stance.up).unrotate(barrel({shot.yaw_rad, shot.pitch_rad}));
  return {std::atan2(d.y, d.x), std::atan2(d.z, norm(xy(d)))};
}

Shot shot_of(const Stance& stance, const GunAngles& angles, double speed_mps) {
  if (stance.level()) return {angles.yaw_rad, angles.pitch_rad, speed_mps};
  const Vec3 d = leaning(stance.up) * barrel(angles);
  return {heading_of(xy(d)), std::atan2(d.z, norm(xy(d))), speed_mps};
}

Shot off_by(const Stance& stance, const Shot& shot, double yaw_rad, double pitch_rad) {
  const GunAngles angles = angles_of(stance, shot);
  return shot_of(stance, {angles.yaw_rad + yaw_rad, angles.pitch_rad + pitch_rad}, shot.speed_mps);
}

double heading_on(const Stance& stance, double heading_rad) {
  if (stance.level()) return heading_rad;
  const Vec3 forward = leaning(stance.up).unrotate(world_T_robot(stance, {{}, heading_rad}).rotation.axes[0]);
  return std::atan2(forward.y, forward.x);
}

Pose3 world_T_robot(const Stance& stance, const Pose2& pose) {
  const Vec2 ahead = direction(pose.heading_rad);
  // The tangent above that direction: its height makes it normal to `up`.
  const Vec3 tangent{ahead.x, ahead.y, -dot(ahead, xy(stance.up)) / stance.up.z};
  const Vec3 x = 1.0 / norm(tangent) * tangent;
  return {{pose.position.x, pose.position.y, stance.ground_z_m}, {{x, cross(stance.up, x), stance.up}}};
}

Vec3 muzzle(const GunModel& gun, const Stance& stance, Vec2 position, const GunAngles& angles) {
  const Vec2 tip = muzzle(gun, angles.pitch_rad);
  const Vec2 along = direction(angles.yaw_rad);
  return Vec3{position.x, position.y, stance.ground_z_m} +
         leaning(stance.up) * Vec3{tip.x * along.x, tip.x * along.y, tip.y};
}

Flight launch(const GunModel& gun, const Stance& stance, Vec2 position, const Shot& shot,
              double gravity_mps2) {
  if (stance.level()) return launch(gun, position, stance.ground_z_m, shot, gravity_mps2);
  return {muzzle(gun, stance, position, angles_of(stance, shot)),
          shot.speed_mps * barrel({shot.yaw_rad, shot.pitch_rad}), gravity_mps2};
}

std::optional<LineOfFire> line_of_fire(const ShotRules& rules, const Stance& stance, Vec2 position, Vec2 aim,
                                       double pitch_rad) {
  if (stance.level()) return LineOfFire{position, elevation(rules, pitch_rad)};
  const Rotation ground = leaning(stance.up);
  const Vec2 reach = muzzle(rules.gun, pitch_rad);
  const double tangent = std::tan(pitch_rad);
  Vec2 along = 1.0 / norm(aim - position) * (aim - position);
  Vec3 tip;  // from the robot's place on the ground
  Vec3 ahead;
  for (int round = 0; round < most_yaw_rounds; ++round) {
    const auto yaw = yaw_towards(ground, along, tangent);
    if (!yaw) return std::nullopt;
    tip = ground * Vec3{reach.x * yaw->x, reach.x * yaw->y, reach.y};
    ahead = ground * Vec3{yaw->x, yaw->y, tangent};
    const Vec2 sight = aim - position - xy(tip);
    if (dot(sight, along) <= 0.0) return std::nullopt;
    const Vec2 before = along;
    along = 1.0 / norm(sight) * sight;
    if (squared_norm(along - before) <= close * close) break;
  }
  const double scale = 1.0 / norm(ahead);
  const double cosine = scale * norm(xy(ahead));
  const double forward = rules.gun.muzzle_speed_mps * cosine;
  const double from_axis = dot(xy(tip), along);
  return LineOfFire{position + xy(tip) - from_axis * along,
                    {std::asin(scale * ahead.z),
                     ahead.z / norm(xy(ahead)),
                     cosine,
                     {from_axis, tip.z},
                     rules.gravity_mps2 / (2.0 * forward * forward)}};
}

double largest_lean_m(const ShotRules& rules) {
  if (!rules.terrain) return 0.0;
  const double sine = rules.terrain->steepest() / std::hypot(1.0, rules.terrain->steepest());
  // The barrel's own upward direction leans aside by that sine over the cosine of its pitch.
  const double pitch = std::max(std::abs(rules.gun.pitch_low_rad), std::abs(rules.gun.pitch_high_rad));
  return sine * (rules.gun.pivot_height_m + std::abs(rules.gun.tip_up_m) / std::cos(pitch));
}

}  // namespace outrider
