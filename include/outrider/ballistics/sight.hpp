// Lines of sight: tests whether the blockers between a place and a target stop a flight.
//
// In the plane of the flight, a rectangle bounds each blocker. A parabola is concave, so it passes above the
// rectangle if it does so at both ends, and below it if its highest point there does. Two smaller rectangles
// lie inside the forbidden region: the height range of the blocker over its grown footprint, and the grown
// height range over its footprint. A parabola that enters one of them is stopped. Only the remaining cases
// need conservative advancement (contact.hpp).
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "outrider/ballistics/blocker.hpp"
#include "outrider/ballistics/shot.hpp"

namespace outrider {

/// A pitch of the gun, with quantities common to all its flights.
struct Elevation {
  double pitch_rad = 0.0;
  double tangent = 0.0;     ///< tangent of the pitch
  double cosine = 1.0;      ///< cosine of the pitch
  Vec2 tip;                 ///< position of the muzzle (gun.hpp)
  double least_drop = 0.0;  ///< k of flight.hpp at the maximum speed of the gun
};

/// Returns the elevation of a pitch on level ground.
Elevation elevation(const ShotRules& rules, double pitch_rad);

/// One parabola in the plane of a line of sight; distances are measured from the yaw axis.
struct Arc {
  const Elevation* at = nullptr;
  double height_m = 0.0;  ///< height of the muzzle, world
  double drop = 0.0;      ///< k of flight.hpp
  double end_m = 0.0;     ///< distance at which it is in the target: its near side, or the aim point
  double lowest_m = 0.0;  ///< lowest height up to that distance, world

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

/// A blocker on a line of sight, with the distances between which the line crosses its polygons. An interval
/// is empty if the line does not cross the polygon.
struct Window {
  const Blocker* blocker = nullptr;
  Interval hull;
  bool looked_inside = false;  ///< `side` and `core` have been computed
  Interval side{1.0, 0.0};
  Interval core{1.0, 0.0};
};

/// The vertical plane through a place and an aim point on a target, with the blockers before the target.
class Sight {
 public:
  Sight(const ShotRules& rules, const Target& target);

  /// Sets the place and the aim point `aim` (world). Only the blockers `near` are considered, in their order;
  /// the object keeps a reference to them.
  void look(Vec2 position, Vec2 aim, const std::vector<const Blocker*>& near);

  [[nodiscard]] Vec2 position() const { return position_; }
  [[nodiscard]] Vec2 along() const { return along_; }  ///< unit vector to the aim point
  /// Returns the arc at that elevation through the height `aim_z_m` at the aim point, or nothing if no speed
  /// achieves it.
  [[nodiscard]] std::optional<Arc> arc(const Elevation& at, double aim_z_m) const;
  [[nodiscard]] Shot shot(const Arc& arc) const;
  /// Returns the first window whose blocker stops the arc before the target; null if the arc hits.
  [[nodiscard]] Window* stopped_by(const Arc& arc);
  [[nodiscard]] bool stops(Window& window, const Arc& arc);
  /// Returns the window of that index among the blockers on the line, in the order of `near`; null after the
  /// last. The pointer stays valid until the next look().
  [[nodiscard]] Window* window(std::size_t index);

  /// Returns how many of the ascending heights at the aim point an arc at that elevation can pass through;
  /// they are always the first ones.
  [[nodiscard]] std::size_t passes(const Elevation& at, const std::vector<double>& aim_z_m) const;
  /// Shrinks the range [first, last) of these heights from both ends by arcs that enter a forbidden rectangle
  /// of the window before the target. At a fixed distance, the height of an arc is linear in its aim height,
  /// so all arcs between two that enter a rectangle there enter it too. The method never claims that an arc
  /// is not stopped.
  void trim(Window& window, const Elevation& at, const std::vector<double>& aim_z_m, std::size_t& first,
            std::size_t& last);
  /// Returns error_ratio() of an arc aimed at the centre of the target.
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
  Solid box_;                    ///< box of the target
  Vec2 axis_;                    ///< direction of its length
  std::vector<Vec2> footprint_;  ///< footprint of the target
  std::vector<Vec2> reach_;      ///< region in which the ball can touch the target
  Vec2 position_;
  Vec2 along_;
  double aim_m_ = 0.0;    ///< distance of the aim point
  double touch_m_ = 0.0;  ///< before this distance the ball cannot touch the target
  double entry_m_ = 0.0;  ///< distance at which the line enters the target's footprint
  const std::vector<const Blocker*>* near_ = nullptr;
  std::size_t looked_at_ = 0;    ///< number of blockers of `near_` that were tested for a window
  std::vector<Window> windows_;  ///< has capacity for all blockers
};

/// Half of the target's extent along and across a line of sight.
struct Outline {
  double along_m;
  double across_m;
};

/// Returns the outline of a target with that heading `axis` for a line of sight `sight`; both are unit
/// vectors.
Outline outline(const Target& target, Vec2 axis, Vec2 sight);

/// Returns error_ratio() (shot.hpp) of the arc with that drop at a target whose centre is `range_m` away.
double error_ratio(const ShotRules& rules, const Target& target, const Outline& half, double range_m,
                   const Elevation& at, double drop);

/// Returns aim points: the midpoints of the chords that lines of sight from `position` cut from the footprint
/// of the target, from its right edge to its left, including the line to its centre. The lines are at most
/// `step_m` apart at the target. Returns none if `position` is the centre of the footprint.
std::vector<Vec2> aim_points(const Target& target, Vec2 position, double step_m);

/// Returns values from low <= 0 to high >= 0, at most `step` apart, including both ends and 0.
std::vector<double> offsets(double low, double high, double step);

/// Returns an upper bound of the distance from the centre of the target at which any point of it can be hit.
double longest_range(const ShotRules& rules, const Target& target);

}  // namespace outrider
