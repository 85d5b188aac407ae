// Quantiles of Student's t from those of the normal distribution.
#pragma once

#include <cstddef>

namespace outrider {

/// Returns the value that Student's t exceeds as often as a normal variable exceeds z > 0. For a z of about 2
/// it is right to 0.2 % from 3 degrees of freedom on, for a z of about 5 to 3 % from 8 on, and too small for
/// fewer. Source: Abramowitz and Stegun, Handbook of Mathematical Functions, 26.7.5.
inline double student_value(double z, std::size_t degrees) {
  const double z2 = z * z;
  const double n = static_cast<double>(degrees);
  const double g1 = (z2 + 1.0) / 4.0;
  const double g2 = ((5.0 * z2 + 16.0) * z2 + 3.0) / 96.0;
  const double g3 = (((3.0 * z2 + 19.0) * z2 + 17.0) * z2 - 15.0) / 384.0;
  const double g4 = ((((79.0 * z2 + 776.0) * z2 + 1482.0) * z2 - 1920.0) * z2 - 945.0) / 92160.0;
  return z * (1.0 + (g1 + (g2 + (g3 + g4 / n) / n) / n) / n);
}

}  // namespace outrider
