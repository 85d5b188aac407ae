// Units and angles. All code uses SI units and radians; degrees occur only in input and output.
#pragma once

#include <cmath>
#include <numbers>

namespace outrider {

inline constexpr double pi = std::numbers::pi;

constexpr double radians(double degrees) { return degrees * (pi / 180.0); }
constexpr double degrees(double radians) { return radians * (180.0 / pi); }

/// Returns the angle of the same direction in (-pi, pi].
inline double wrap_angle(double angle_rad) {
  const double wrapped = std::remainder(angle_rad, 2.0 * pi);
  return wrapped <= -pi ? pi : wrapped;
}

}  // namespace outrider
