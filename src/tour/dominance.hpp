// Dominance: when one partial tour stands for another that served the same goals at the same stop, and the
// queue in which such labels wait.
#pragma once

#include "instance.hpp"

namespace outrider::tour {

/// A label that waits for its turn.
struct Open {
  double estimate = 0.0;
  std::uint32_t label = 0;
  /// The queue gives the least estimate first, then the newest label.
  bool operator<(const Open& other) const {
    return estimate != other.estimate ? estimate > other.estimate : label < other.label;
  }
};

/// The most that A can lose on B, besides their difference in time, if both go on alike: the robot turns
/// by the difference of headings, and the gun makes up for its own difference. Here the next thing is a
/// drive, after which it does so at the next stop. O(1).
inline double loss_before_a_drive(const Instance& instance, const State& a, const State& b) {
  return turn_time(instance, a.heading, b.heading) + aim_time(instance, a.yaw, a.pitch, b.yaw, b.pitch);
}

/// The same where something may be served before the robot drives: the gun makes up for the difference in the
/// world at once, and for that of the headings after the drive.
inline double loss_before_a_service(const Instance& instance, const State& a, const State& b) {
  const double turn = turn_time(instance, a.heading, b.heading);
  const double heading_gap = angle_between(a.heading, b.heading);
  const double yaw_gap = std::abs(wrap_angle(a.heading + a.yaw - b.heading - b.yaw)) / instance.yaw_rate;
  const double pitch_gap = std::abs(a.pitch - b.pitch) / instance.pitch_rate;
  return turn + heading_gap / instance.yaw_rate + std::max(yaw_gap, pitch_gap);
}

}  // namespace outrider::tour
