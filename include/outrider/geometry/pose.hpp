// Poses: where a frame stands in another. Frames stand in names: world_T_robot.
#pragma once

#include "outrider/geometry/vec.hpp"

namespace outrider {

struct Pose2 {
  Vec2 position;             ///< m
  double heading_rad = 0.0;  ///< counter-clockwise from +x

  friend bool operator==(const Pose2&, const Pose2&) = default;
};

inline bool finite(const Pose2& pose) { return finite(pose.position) && std::isfinite(pose.heading_rad); }

struct Pose3 {
  Vec3 position;
  Rotation rotation;

  /// A point given in this frame, in the parent's frame.
  friend constexpr Vec3 operator*(const Pose3& t, Vec3 p) { return t.position + t.rotation * p; }
  friend constexpr Pose3 operator*(const Pose3& a, const Pose3& b) {
    return {a * b.position, a.rotation * b.rotation};
  }
  /// A point of the parent's frame, in this frame.
  [[nodiscard]] constexpr Vec3 to_local(Vec3 p) const { return rotation.unrotate(p - position); }
};

}  // namespace outrider
