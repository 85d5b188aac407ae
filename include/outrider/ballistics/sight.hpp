// Lines of sight: do the blockers on the way from a place to a target stop a flight?
//
// In the plane of the flight a blocker is bounded by a rectangle that a parabola, being concave, passes
// above when both ends do, and below when its highest point does; only what is left is decided by
// conservative advancement (contact.hpp).
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "outrider/ballistics/blocker.hpp"
#include "outrider/ballistics/shot.hpp"

namespace outrider {

/// One parabola in the plane of a line of sight; distances are measured from the yaw axis.
struct Arc {
  Shot shot;
  double start_m = 0.0;   ///< distance of the muzzle
  double height_m = 0.0;  ///< of the muzzle, world
  double tangent = 0.0;
  double drop = 0.0;         ///< k of flight.hpp
  double forward_mps = 0.0;  ///< horizontal speed

  [[nodiscard]] double z(double distance_m) const {
    const double s = distance_m - start_m;
    return height_m + s * (tangent - drop * s);
  }
  [[nodiscard]] double highest(double from_m, double to_m) const {
    return z(std::clamp(start_m + tangent / (2.0 * drop), from_m, to_m));
  }
  [[nodiscard]] double time(double distance_m) const { return (distance_m - start_m) / forward_mps; }
};

/// A blocker on a line of sight: the distances between which its grown footprint is crossed, and
/// between which its core is (empty interval when it is not).
struct Window {
  const Blocker* blocker = nullptr;
  Interval grown;
  Interval core;
};

/// The plane through a place and an aim point, with what stands in it before the target.
struct Sight {
  const ShotRules* rules = nullptr;
  const Target* target = nullptr;
  Vec2 position;
  Vec2 along;            ///< unit vector to the aim point
  double aim_m = 0.0;    ///< distance of the aim point
  double touch_m = 0.0;  ///< before this distance the ball cannot touch the target
  double entry_m = 0.0;  ///< distance at which the line enters the target's footprint
  std::vector<Window> windows;

  /// The arc at that pitch through height `aim_z` at the aim point; nothing when no speed does it.
  [[nodiscard]] std::optional<Arc> arc(double pitch_rad, Vec2 tip, double tangent, double cosine,
                                       double aim_z_m) const;
  /// The first blocker in the list that stops the arc before the target; null when it hits.
  [[nodiscard]] const Blocker* stopped_by(const Arc& arc) const;
};

/// Middles of the chords that lines of sight from `position` cut from the target's footprint, from its
/// right edge to its left, the line to its centre among them; at that distance they are at most `step_m`
/// apart. None from inside the footprint's centre.
std::vector<Vec2> aim_points(const Target& target, Vec2 position, double step_m);

/// Offsets from low <= 0 to high >= 0 with both ends and 0 among them, at most `step` apart.
std::vector<double> offsets(double low, double high, double step);

/// Fills `sight` for the aim point `aim` (world) from `position`, looking at `near` blockers only.
void look(Sight& sight, const ShotRules& rules, const Target& target, Vec2 position, Vec2 aim,
          const std::vector<const Blocker*>& near);

/// No place farther than this from the target's centre can hit any point of it.
double longest_range(const ShotRules& rules, const Target& target);

}  // namespace outrider
