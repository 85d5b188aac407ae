// Stance: how a robot stands on the ground, and how its gun leans with it.
//
// On a slope the robot's vertical axis is the normal of the ground. The frame of the ground at a place has
// that axis as z and is else turned as little as possible against the world: R_up takes z to the normal
// about a horizontal axis. In it the gun's joints do what they do on a level floor: the yaw axis stands on
// z, the pitch counts from the tangent plane. A Shot stays a direction of the world; the angles of the gun
// are that direction in this frame. On level ground both are the same, to the bit.
// Units: metres, radians.
#pragma once

#include <optional>

#include "outrider/ballistics/sight.hpp"

namespace outrider {

struct Stance {
  double ground_z_m = 0.0;  ///< height of the ground under the robot's centre
  Vec3 up{0.0, 0.0, 1.0};   ///< its normal, of length 1

  [[nodiscard]] bool level() const { return up.z == 1.0; }
};

/// On the terrain of the rules, or on their floor.
Stance stance_at(const ShotRules& rules, Vec2 position);

/// R_up of the text above.
Rotation leaning(Vec3 up);

GunAngles angles_of(const Stance& stance, const Shot& shot);
Shot shot_of(const Stance& stance, const GunAngles& angles, double speed_mps);
/// The shot that leaves when both joints are off by that much.
Shot off_by(const Stance& stance, const Shot& shot, double yaw_rad, double pitch_rad);
/// The heading of a body, the direction of its forward axis seen from above, as a yaw in the frame of the
/// ground.
double heading_on(const Stance& stance, double heading_rad);
/// The pose of the body: x forward, z the normal of the ground, on which its origin lies.
Pose3 world_T_robot(const Stance& stance, const Pose2& pose);

/// The muzzle of the gun with these angles, world.
Vec3 muzzle(const GunModel& gun, const Stance& stance, Vec2 position, const GunAngles& angles);
/// The flight of a shot from there.
Flight launch(const GunModel& gun, const Stance& stance, Vec2 position, const Shot& shot,
              double gravity_mps2);

/// The upright plane of a flight at some pitch of the gun that passes over an aim point. On a slope the
/// muzzle is not above the line from the robot to the aim.
struct LineOfFire {
  Vec2 from;     ///< on the line, `at.tip.x` behind the muzzle
  Elevation at;  ///< of the flight; heights count from the ground under the robot
};

/// Nothing when the barrel cannot point that way at that pitch of its joint. Otherwise to 1e-12 m, by fixed
/// point iteration: the muzzle moves with the yaw, by a part of the distance to the aim.
std::optional<LineOfFire> line_of_fire(const ShotRules& rules, const Stance& stance, Vec2 position, Vec2 aim,
                                       double pitch_rad);

/// No line of fire is farther than this from the robot's centre.
double largest_lean_m(const ShotRules& rules);

}  // namespace outrider
