// Stance: the attitude of a robot on sloping ground, and the resulting inclination of its gun.
//
// On a slope, the vertical axis of the robot is the normal of the ground. The frame of the ground at a place
// has this axis as z and the smallest possible rotation against the world: R_up rotates z into the normal
// about a horizontal axis. In this frame the joints of the gun act as on a level floor: the yaw axis is z,
// and the pitch is measured from the tangent plane. A Shot remains a direction in the world; the angles of
// the gun are that direction in the frame of the ground. On level ground both are equal, bit by bit. Units:
// metres, radians.
#pragma once

#include <optional>

#include "outrider/ballistics/sight.hpp"

namespace outrider {

/// The height and the normal of the ground under a robot.
struct Stance {
  double ground_z_m = 0.0;  ///< height of the ground under the robot's centre
  Vec3 up{0.0, 0.0, 1.0};   ///< unit normal of the ground

  [[nodiscard]] bool level() const { return up.z == 1.0; }
};

/// Returns the stance at a position, on the terrain of the rules or on their flat floor.
Stance stance_at(const ShotRules& rules, Vec2 position);

/// Returns the rotation R_up defined above.
Rotation leaning(Vec3 up);

/// Convert between a shot in the world and the joint angles of the gun.
GunAngles angles_of(const Stance& stance, const Shot& shot);
Shot shot_of(const Stance& stance, const GunAngles& angles, double speed_mps);
/// Returns the shot that results if both joints have these errors.
Shot off_by(const Stance& stance, const Shot& shot, double yaw_rad, double pitch_rad);
/// Converts the heading of a body (the direction of its forward axis seen from above) to a yaw in the frame
/// of the ground.
double heading_on(const Stance& stance, double heading_rad);
/// Returns the pose of the body: x points forward, z is the normal of the ground, and the origin lies on the
/// ground.
Pose3 world_T_robot(const Stance& stance, const Pose2& pose);

/// Returns the position of the muzzle for these joint angles, world frame.
Vec3 muzzle(const GunModel& gun, const Stance& stance, Vec2 position, const GunAngles& angles);
/// Returns the flight of a shot of a robot at `position`.
Flight launch(const GunModel& gun, const Stance& stance, Vec2 position, const Shot& shot,
              double gravity_mps2);

/// The vertical plane of a flight that passes over an aim point, at some pitch of the gun. On a slope, the
/// muzzle is not above the line from the robot to the aim point.
struct LineOfFire {
  Vec2 from;     ///< point on the line, `at.tip.x` behind the muzzle
  Elevation at;  ///< elevation of the flight; heights are above the ground under the robot
};

/// Returns the line of fire, accurate to 1e-12 m, by fixed-point iteration: the position of the muzzle
/// depends on the yaw, by a fraction of the distance to the aim point. Returns nothing if the barrel cannot
/// point that way at that joint pitch.
std::optional<LineOfFire> line_of_fire(const ShotRules& rules, const Stance& stance, Vec2 position, Vec2 aim,
                                       double pitch_rad);

/// Returns an upper bound of the distance between a line of fire and the robot's centre.
double largest_lean_m(const ShotRules& rules);

}  // namespace outrider
