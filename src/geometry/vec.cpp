#include "outrider/geometry/vec.hpp"

namespace outrider {

Rotation Rotation::from_rpy(double roll_rad, double pitch_rad, double yaw_rad) {
  const double cr = std::cos(roll_rad);
  const double sr = std::sin(roll_rad);
  const double cp = std::cos(pitch_rad);
  const double sp = std::sin(pitch_rad);
  const double cy = std::cos(yaw_rad);
  const double sy = std::sin(yaw_rad);
  return {{Vec3{cy * cp, sy * cp, -sp}, Vec3{cy * sp * sr - sy * cr, sy * sp * sr + cy * cr, cp * sr},
           Vec3{cy * sp * cr + sy * sr, sy * sp * cr - cy * sr, cp * cr}}};
}

}  // namespace outrider
