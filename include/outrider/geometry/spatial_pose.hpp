// Composition and inverse of poses in space, as pose.hpp has them for the plane, and the pose seen from
// above.
#pragma once

#include "outrider/geometry/pose.hpp"

namespace outrider {

/// Returns a_T_c.
constexpr Pose3 compose(const Pose3& a_T_b, const Pose3& b_T_c) { return a_T_b * b_T_c; }

/// Returns b_T_a.
constexpr Pose3 inverse(const Pose3& a_T_b) {
  const auto& [x, y, z] = a_T_b.rotation.axes;
  const Rotation back = {{Vec3{x.x, y.x, z.x}, Vec3{x.y, y.y, z.y}, Vec3{x.z, y.z, z.z}}};
  return {-1.0 * (back * a_T_b.position), back};
}

/// Returns the pose seen from above: x, y, and the heading of its x axis.
inline Pose2 plan_pose(const Pose3& pose) {
  return {xy(pose.position), heading_of(xy(pose.rotation.axes[0]))};
}

}  // namespace outrider
