// Twists in the plane: velocities of a body, and the poses that they lead to.
//
// A constant twist moves a body along an arc. moved() is the exponential map of SE(2), the group of planar
// motions, and twist_between() is its logarithm. Both are exact and O(1).
// Source: Lynch and Park, Modern Robotics, section 3.2.
#pragma once

#include "outrider/geometry/pose.hpp"

namespace outrider {

/// The velocity of a body in its own frame.
struct Twist2 {
  double ahead_mps = 0.0;
  double left_mps = 0.0;
  double turn_radps = 0.0;  ///< counter-clockwise

  friend constexpr Twist2 operator+(const Twist2& a, const Twist2& b) {
    return {a.ahead_mps + b.ahead_mps, a.left_mps + b.left_mps, a.turn_radps + b.turn_radps};
  }
  friend constexpr Twist2 operator*(double s, const Twist2& a) {
    return {s * a.ahead_mps, s * a.left_mps, s * a.turn_radps};
  }
  friend constexpr bool operator==(const Twist2&, const Twist2&) = default;
};

inline double speed_of(const Twist2& twist) { return norm(Vec2{twist.ahead_mps, twist.left_mps}); }

/// Returns the pose after a motion with a constant twist for `duration_s`; the heading is not wrapped.
Pose2 moved(const Pose2& from, const Twist2& twist, double duration_s);

/// Returns the constant twist that moves a body from one pose to another in `duration_s` > 0. The body turns
/// by the difference of the headings, which is not wrapped and must be less than a whole turn.
Twist2 twist_between(const Pose2& from, const Pose2& to, double duration_s);

}  // namespace outrider
