// Lines of sight: do the blockers on the way from a place to a target stop a flight?
//
// In the plane of the flight a blocker is bounded by a rectangle that a parabola, being concave, passes
// above when both ends do, and below when its highest point does. Two smaller rectangles lie in what it
// forbids: its height over the grown footprint, and the grown height over the footprint; a parabola that
// is in one of them is stopped. Only what is left is decided by conservative advancement (contact.hpp).
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "outrider/ballistics/blocker.hpp"
#include "outrider/ballistics/shot.hpp"

namespace outrider {

/// A pitch of the gun, with what all its flights share.
struct Elevation {
  double pitch_rad = 0.0;
  double tangent = 0.0;
  double cosine = 1.0;
  Vec2 tip;                 ///< the muzzle (gun.hpp)
  double least_drop = 0.0;  ///< k of flight.hpp at the gun's largest speed
};

Elevation elevation(const ShotRules& rules, double pitch_rad);

/// One parabola in the plane of a line of sight; distances are measured from the yaw axis.
struct Arc {
  const Elevation* at = nullptr;
  double height_m = 0.0;  ///< of the muzzle, world
  double drop = 0.0;      ///< k of flight.hpp
  double end_m = 0.0;     ///< where it is in the target: at its near side, or else at the aim point
  double lowest_m = 0.0;  ///< height that it does not fall below until there, world

  [[nodiscard]] double start_m() const { return at->tip.x; }
  [[nodiscard]] double z(double distance_m) const {
    const double s = distance_m - start_m();
    return height_m + s * (at->tangent - drop * s);
  }
  [[nodiscard]] double highest(double from_m, double to_m) const {
    return z(std::clamp(start_m() + at->tangent / (2.0 * drop), from_m, to_m));
  }
  [[nodiscard]] double forward_mps(double gravity_mps2) const {
    return std::sqrt(gravity_mps2 / (2.0 * drop));
  }
  [[nodiscard]] double speed_mps(double gravity_mps2) const { return forward_mps(gravity_mps2) / at->cosine; }
};

/// A blocker on a line of sight: the distances between which its polygons are crossed; an interval is empty
/// where one is not.
struct Window {
  const Blocker* blocker = nullptr;
  Interval hull;
  bool looked_inside = false;  ///< side and core are known
  Interval side{1.0, 0.0};
  Interval core{1.0, 0.0};
};

/// The plane through a place and an aim point on a target, with what stands in it before the target.
class Sight {
 public:
  Sight(const ShotRules& rules, const Target& target);

  /// Turns to the aim point `aim` (world) from `position`, among the blockers `near` only, which are asked in
  /// their order and kept by reference.
  void look(Vec2 position, Vec2 aim, const std::vector<const Blocker*>& near);

  [[nodiscard]] Vec2 position() const { return position_; }
  [[nodiscard]] Vec2 along() const { return along_; }  ///< unit vector to the aim point
  /// The arc at that elevation through height `aim_z` at the aim point; nothing when no speed does it.
  [[nodiscard]] std::optional<Arc> arc(const Elevation& at, double aim_z_m) const;
  [[nodiscard]] Shot shot(const Arc& arc) const;
  /// The first window whose blocker stops the arc before the target; null when it hits.
  [[nodiscard]] Window* stopped_by(const Arc& arc);
  [[nodiscard]] bool stops(Window& window, const Arc& arc);
  /// The window of that index among those on the line, in the order of `near`; null after the last. Stays
  /// where it is until the next look().
  [[nodiscard]] Window* window(std::size_t index);

  /// Of ascending heights at the aim point, how many an arc at that elevation passes: the first ones.
  [[nodiscard]] std::size_t passes(const Elevation& at, const std::vector<double>& aim_z_m) const;
  /// Takes from both ends of the part [first, last) of these heights those whose arcs are seen inside what
  /// the window forbids, before the target. At one distance the height of an arc is linear in that of its
  /// aim, so what is in between two of them is seen there as well. Never says that an arc is not stopped.
  void trim(Window& window, const Elevation& at, const std::vector<double>& aim_z_m, std::size_t& first,
            std::size_t& last);
  /// error_ratio() of an arc whose aim point is the target's centre.
  [[nodiscard]] double error_ratio(const Arc& arc) const;

 private:
  [[nodiscard]] double fall(const Elevation& at, double reach_m, double aim_z_m) const {
    return rules_.floor_z_m + at.tip.y + reach_m * at.tangent - aim_z_m;
  }
  void look_inside(Window& window) const;
  [[nodiscard]] bool enters(const Arc& arc, Interval over, double low_m, double high_m) const;
  [[nodiscard]] bool touches(const Window& window, const Arc& arc, double from_m, double to_m) const;

  const ShotRules& rules_;
  const Target& target_;
  Solid box_;                    ///< the target
  Vec2 axis_;                    ///< of its length
  std::vector<Vec2> footprint_;  ///< of the target
  std::vector<Vec2> reach_;      ///< and where the ball can touch it
  Vec2 position_;
  Vec2 along_;
  double aim_m_ = 0.0;    ///< distance of the aim point
  double touch_m_ = 0.0;  ///< before this distance the ball cannot touch the target
  double entry_m_ = 0.0;  ///< distance at which the line enters the target's footprint
  const std::vector<const Blocker*>* near_ = nullptr;
  std::size_t looked_at_ = 0;    ///< of `near_`, how many have their window if they have one
  std::vector<Window> windows_;  ///< room for all of them
};

/// Half of the target's size along and across a direction of sight; both directions are unit vectors.
struct Outline {
  double along_m;
  double across_m;
};

Outline outline(const Target& target, Vec2 axis, Vec2 sight);

/// error_ratio() (shot.hpp) of the arc with that drop at the target whose centre is `range_m` away.
double error_ratio(const ShotRules& rules, const Target& target, const Outline& half, double range_m,
                   const Elevation& at, double drop);

/// Middles of the chords that lines of sight from `position` cut from the target's footprint, from its
/// right edge to its left, the line to its centre among them; at that distance they are at most `step_m`
/// apart. None from inside the footprint's centre.
std::vector<Vec2> aim_points(const Target& target, Vec2 position, double step_m);

/// Offsets from low <= 0 to high >= 0 with both ends and 0 among them, at most `step` apart.
std::vector<double> offsets(double low, double high, double step);

/// No place farther than this from the target's centre can hit any point of it.
double longest_range(const ShotRules& rules, const Target& target);

}  // namespace outrider
