// A target that moves while the ball flies: when the ball touches it, and where to aim so that it does.
//
// Frames and units: world, metres, seconds on one clock for the walk and the shot.
#pragma once

#include <optional>
#include <vector>

#include "outrider/ballistics/shot.hpp"

namespace outrider {

/// Somebody's whereabouts: straight and at constant speed from knot to knot, at the first before it, at the
/// last after it. At least one knot, times ascending.
struct Walk {
  struct Knot {
    double time_s = 0.0;
    Vec2 position;
  };
  std::vector<Knot> knots;

  /// O(log knots).
  [[nodiscard]] Vec2 at(double time_s) const;
};

/// The target at another place; its height and heading stay.
Target moved_to(const Target& target, Vec2 place);

/// fly() (shot.hpp) at a target that walks, for a ball that leaves at `fired_s`. By conservative advancement
/// on each straight piece, with the speed of the ball against the target: nothing is skipped, however thin.
Impact fly_at(const Flight& flight, double ball_radius_m, const FlightSpace& space, const Target& target,
              const Walk& walk, double fired_s, double floor_z_m);

struct LedShot {
  PlannedShot planned;
  double fires_s = 0.0;  ///< when the barrel is there
  double meets_s = 0.0;  ///< when the ball passes the target's centre
};

/// The shot that leads: the barrel is brought from where it is, beginning at `now_s`, the ball leaves at
/// once, and passes the target's centre where the walk has it then. The pitch is that of best_shot() at the
/// place of the meeting; at that pitch the time of the meeting T = aiming(T) + flight(T) is solved by fixed
/// point iteration to 1e-12 s (1e-7 s in air), which converges when the target is slower than the ball and is
/// not close by. At a target that rests it is best_shot(). Nothing when that finds none, when there is no
/// fixed point, or when the shot does not hit the walk. On level ground only.
std::optional<LedShot> led_shot(const ShotRules& rules, const FlightSpace& space, const Target& target,
                                const Walk& walk, Vec2 position, double yaw_rad, double pitch_rad,
                                double now_s);

}  // namespace outrider
