#include "outrider/motion/profile.hpp"

#include <algorithm>
#include <cmath>

namespace outrider {
namespace {

/// Returns the highest speed reached: the limit, or less if the distance is too short for it.
double peak_speed(double distance, const Limits& limits) {
  return std::min(limits.speed, std::sqrt(distance * limits.acceleration));
}

}  // namespace

double duration(double distance, const Limits& limits) {
  if (distance <= 0.0) return 0.0;
  const double peak = peak_speed(distance, limits);
  return distance / peak + peak / limits.acceleration;
}

double covered(double distance, const Limits& limits, double time_s) {
  const double total = duration(distance, limits);
  if (time_s <= 0.0 || distance <= 0.0) return 0.0;
  if (time_s >= total) return distance;
  const double peak = peak_speed(distance, limits);
  const double ramp = peak / limits.acceleration;
  if (time_s < ramp) return 0.5 * limits.acceleration * time_s * time_s;
  const double left = total - time_s;
  if (left < ramp) return distance - 0.5 * limits.acceleration * left * left;
  return peak * (time_s - 0.5 * ramp);
}

double speed_after(double distance, const Limits& limits, double time_s) {
  const double left = duration(distance, limits) - time_s;
  if (time_s <= 0.0 || left <= 0.0) return 0.0;
  // min() comes last: with an infinite acceleration the robot has full speed at once.
  return std::min(peak_speed(distance, limits), limits.acceleration * std::min(time_s, left));
}

}  // namespace outrider
