// Shooting in passing: shots that leave while the robot drives along a straight of its way.
//
// The robot follows its way as drive_cost() (motion/robot_model.hpp) counts it: it turns in place, then
// drives straight from rest to rest. While it drives, the gun turns to the next shot, from the beginning of
// the straight or from the shot before; the ball leaves with the velocity of the barrel and that of the
// robot. Nobody waits for a ball but at the end of the way. Level ground only, with air or without.
//
// Frames and units: world, metres, seconds, radians; `after_s` counts from the beginning of a straight.
#pragma once

#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "outrider/jobs/guard/firing_map.hpp"
#include "outrider/jobs/guard/problem.hpp"
#include "outrider/robot/observation.hpp"

namespace outrider {

/// One straight of a way, and when it is driven.
struct Straight {
  std::size_t leg = 0;  ///< it ends at this waypoint
  Vec2 from;
  Vec2 to;
  double begin_s = 0.0;  ///< from the beginning of the way, the turns counted
  double length_s = 0.0;
};

/// Those of a way, in order; waypoints at one place make none. O(waypoints).
std::vector<Straight> straights(const RobotModel& robot, double heading_rad,
                                const std::vector<Vec2>& waypoints);

/// Where the robot is on a straight, and how fast, that long after it began.
Platform platform_on(const RobotModel& robot, Vec2 from, Vec2 to, double after_s);

/// A shot at a target in passing.
struct PassingHit {
  std::size_t target = 0;
  std::size_t leg = 0;    ///< of the way, as in Straight
  double after_s = 0.0;   ///< when the ball leaves
  double leaves_s = 0.0;  ///< the same from the beginning of the way
  PlannedShot shot;
};

/// When the last ball of a way has landed, from its beginning; 0 without any.
double last_landing_s(const std::vector<PassingHit>& passing);

/// After the last of these shots, which are on that way; `before` without any.
GunState gun_after(const std::vector<Vec2>& waypoints, const std::vector<PassingHit>& passing,
                   GunState before);

/// Finds shots in passing. Remembers those it has solved; not for two threads at once.
class PassingShots {
 public:
  /// The references must outlive it.
  PassingShots(const GuardProblem& problem, const FiringMap& firing_map)
      : problem_(problem), site_(firing_map) {}

  /// At each moment of the way, 0.2 s apart, one of the targets that can be hit then and that the gun gets to
  /// in time is shot at: the one whose last moment on the way comes first. Each target once at most; in the
  /// order of shooting. O(moments x targets) shots.
  std::vector<PassingHit> along(double heading_rad, const std::vector<Vec2>& waypoints, GunState gun,
                                const std::vector<std::size_t>& targets);

 private:
  using Moment = std::tuple<double, double, double, double, double, bool, std::size_t>;

  /// By target: its shots on the way, in the order of their moments.
  std::vector<std::vector<PassingHit>> offers(const std::vector<Straight>& way,
                                              const std::vector<std::size_t>& targets);
  const std::optional<PlannedShot>& at(const Straight& straight, bool last, double after_s,
                                       std::size_t target);

  const GuardProblem& problem_;
  const FiringMap& site_;
  std::map<Moment, std::optional<PlannedShot>> solved_;
};

/// The shot at the target's centre that is soonest there of those on the pitch lattice which keep the margin,
/// forgive enough (a error_ratio of at most 0.7), and hit under all extreme errors together: of the gun, of
/// the muzzle speed, of the moment, and, on the last straight of a way, of the place where it ends. Tried
/// only where a robot that stands could hit the target.
std::optional<PlannedShot> passing_shot(const GuardProblem& problem, const FiringMap& firing_map,
                                        std::size_t target, const Straight& straight, bool last,
                                        double after_s);

}  // namespace outrider
