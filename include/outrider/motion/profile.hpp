// Trapezoidal motion: from rest to rest over a distance, with limited speed and acceleration.
//
// The functions work for metres and for radians.
// Source: Lynch and Park, Modern Robotics, section 9.2.2.2.
#pragma once

namespace outrider {

/// Limits of a motion. The unit is m or rad.
struct Limits {
  double speed = 1.0;         ///< > 0, unit per second
  double acceleration = 1.0;  ///< > 0, unit per second squared; infinite: full speed at once
};

/// Returns the least time to cover `distance` >= 0 from rest to rest, s. O(1).
double duration(double distance, const Limits& limits);

/// Returns the distance covered `time_s` after the start of that motion; clamped to [0, distance]. O(1).
double covered(double distance, const Limits& limits, double time_s);

/// Returns the speed `time_s` after the start of that motion; 0 before it and from its end on. O(1).
double speed_after(double distance, const Limits& limits, double time_s);

}  // namespace outrider
