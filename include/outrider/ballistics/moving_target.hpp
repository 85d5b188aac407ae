// Moving targets: the contact of a ball with a target that moves during the flight, and the shot that leads
// it.
//
// Frames and units: world, metres, seconds on one clock for the walk and the shot.
#pragma once

#include <optional>
#include <vector>

#include "outrider/ballistics/shot.hpp"

namespace outrider {

/// The motion of a target: straight and with constant speed between consecutive knots. Before the first knot
/// the target rests there, after the last knot it rests there. There is at least one knot, and times are
/// ascending.
struct Walk {
  /// A position at a time.
  struct Knot {
    double time_s = 0.0;
    Vec2 position;
  };
  std::vector<Knot> knots;

  /// Returns the position at a time. O(log knots).
  [[nodiscard]] Vec2 at(double time_s) const;
};

/// Returns the target at another place, with the same height and heading.
Target moved_to(const Target& target, Vec2 place);

/// Like fly() (shot.hpp), for a walking target and a ball that leaves at `fired_s`. It uses conservative
/// advancement on each straight piece of the walk, with the relative speed of ball and target, so no contact
/// is missed.
Impact fly_at(const Flight& flight, double ball_radius_m, const FlightSpace& space, const Target& target,
              const Walk& walk, double fired_s, double floor_z_m);

/// A shot that leads a moving target.
struct LedShot {
  PlannedShot planned;
  double fires_s = 0.0;  ///< time at which the barrel is aimed and the gun fires
  double meets_s = 0.0;  ///< time at which the ball passes the centre of the target
};

/// Returns the shot that leads a walking target. The barrel starts to turn from its present direction at
/// `now_s`, and the ball leaves as soon as the barrel is aimed. It passes the centre of the target at the
/// place where the walk has it then. The pitch is that of best_shot() at the meeting place. For that pitch,
/// the equation T = aiming(T) + flight(T) for the meeting time T is solved by fixed-point iteration to 1e-12
/// s (1e-7 s in air). The iteration converges if the target is slower than the ball and not close by. For a
/// target at rest the result is best_shot(). Returns nothing if best_shot() finds no shot, if there is no
/// fixed point, or if the shot misses the walking target. Level ground only.
std::optional<LedShot> led_shot(const ShotRules& rules, const FlightSpace& space, const Target& target,
                                const Walk& walk, Vec2 position, double yaw_rad, double pitch_rad,
                                double now_s);

}  // namespace outrider
