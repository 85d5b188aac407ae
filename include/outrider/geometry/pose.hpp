// Poses in the plane, SE(2), and in space, SE(3): the position and orientation of one frame in another.
//
// Names state the frames: a_T_b is the pose of frame b in frame a; it transforms points of b to points of a.
// Headings are added and subtracted without wrapping, so a pose can count whole turns; wrap_heading() brings
// a heading to (-pi, pi]. All operations are O(1).
#pragma once

#include "outrider/core/units.hpp"
#include "outrider/geometry/vec.hpp"

namespace outrider {

struct Pose2 {
  Vec2 position;             ///< m
  double heading_rad = 0.0;  ///< counter-clockwise from +x

  friend bool operator==(const Pose2&, const Pose2&) = default;
  /// Transforms a point from this frame to the parent frame.
  friend Vec2 operator*(const Pose2& t, Vec2 p) { return t.position + rotated(t.heading_rad, p); }
  /// Transforms a point from the parent frame to this frame.
  [[nodiscard]] Vec2 to_local(Vec2 p) const { return unrotated(heading_rad, p - position); }
};

inline bool finite(const Pose2& pose) { return finite(pose.position) && std::isfinite(pose.heading_rad); }

/// Returns the same pose with its heading in (-pi, pi].
inline Pose2 wrap_heading(const Pose2& pose) { return {pose.position, wrap_angle(pose.heading_rad)}; }

/// Returns a_T_c.
inline Pose2 compose(const Pose2& a_T_b, const Pose2& b_T_c) {
  return {a_T_b * b_T_c.position, a_T_b.heading_rad + b_T_c.heading_rad};
}

/// Returns b_T_c, the pose of c in the frame of b.
inline Pose2 relative_pose(const Pose2& a_T_b, const Pose2& a_T_c) {
  return {a_T_b.to_local(a_T_c.position), a_T_c.heading_rad - a_T_b.heading_rad};
}

/// Returns b_T_a.
inline Pose2 inverse(const Pose2& a_T_b) { return relative_pose(a_T_b, {}); }

struct Pose3 {
  Vec3 position;
  Rotation rotation;

  /// Transforms a point from this frame to the parent frame.
  friend constexpr Vec3 operator*(const Pose3& t, Vec3 p) { return t.position + t.rotation * p; }
  friend constexpr Pose3 operator*(const Pose3& a, const Pose3& b) {
    return {a * b.position, a.rotation * b.rotation};
  }
  /// Transforms a point from the parent frame to this frame.
  [[nodiscard]] constexpr Vec3 to_local(Vec3 p) const { return rotation.unrotate(p - position); }
};

}  // namespace outrider
