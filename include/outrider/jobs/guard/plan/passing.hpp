// Shots in passing: shots fired while the robot drives along a straight leg of its path.
//
// The robot follows the path as drive_cost() (motion/robot_model.hpp) counts it: it turns in place, then
// drives straight from rest to rest. Meanwhile the gun turns to the next shot, from the beginning of the path
// or from the previous shot on. The velocity of the ball is its muzzle velocity plus the velocity of the
// robot. Nobody waits for a ball to land. On level ground, with or without air, and on terrain.
//
// Frames and units: world, metres, seconds, radians; `after_s` counts from the beginning of a leg.
#pragma once

#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include "outrider/jobs/guard/problem.hpp"
#include "outrider/jobs/guard/yard/firing_map.hpp"
#include "outrider/motion/straights.hpp"
#include "outrider/robot/observation.hpp"

namespace outrider {

/// Returns position and velocity of the robot `after_s` after the beginning of a leg.
Platform platform_on(const RobotModel& robot, Vec2 from, Vec2 to, double after_s,
                     const HeightField* terrain = nullptr);

/// Returns the joints of the gun, relative to the body of a robot there, for a barrel with these angles.
GunState joints_of(const FiringMap& firing_map, const Pose2& robot, const GunAngles& barrel);

/// A planned shot in passing.
struct PassingHit {
  std::size_t target = 0;
  std::size_t leg = 0;    ///< as in Straight
  double after_s = 0.0;   ///< firing time, counted from the beginning of the leg
  double leaves_s = 0.0;  ///< firing time, counted from the beginning of the path
  PlannedShot shot;
  GunState gun;  ///< joints of the gun at that time
};

/// Returns the time at which the last ball lands, counted from the beginning of the path; 0 if there is none.
double last_landing_s(const std::vector<PassingHit>& passing);

/// Returns the state of the gun after the last shot along the path; `before` if there is no shot.
GunState gun_after(const std::vector<PassingHit>& passing, GunState before);

/// Finds shots in passing and caches the solved ones. Thread rule: use each object from one thread.
class PassingShots {
 public:
  /// The arguments must outlive this object.
  PassingShots(const GuardProblem& problem, const FiringMap& firing_map)
      : problem_(problem), firing_map_(firing_map) {}

  /// Chooses shots along a path. It tries firing times 0.2 s apart. At each of them it considers the targets
  /// that can be hit and that the gun can be aimed at in time, and shoots at the one whose firing region the
  /// robot leaves first. Each target is shot at no more than once. Returns the
  /// shots in the order of firing. Solves the shots that it considers, once each; O(sum of the targets in
  /// whose regions the robot is, over the firing times).
  std::vector<PassingHit> along(double heading_rad, const std::vector<Vec2>& waypoints, GunState gun,
                                const std::vector<std::size_t>& targets);

 private:
  /// A shot at one of the firing times of a leg.
  struct LegShot {
    PlannedShot shot;
    GunState gun;  ///< joints of the gun
  };
  static constexpr std::uint32_t unsolved = 0xffffffff, no_shot = 0xfffffffe;
  /// A target that a standing robot could hit from where the robot is at some firing time.
  struct Chance {
    std::uint32_t target = 0;
    std::uint32_t shot = unsolved;  ///< index in the leg
  };
  struct Leg {
    std::vector<std::vector<Chance>> moments;  ///< by firing time
    std::vector<LegShot> shots;
  };

  /// The shots along one path while they are chosen.
  struct Salvo {
    GunState gun;
    double ready_s = 0.0;      ///< when the gun may fire if it need not turn, from the beginning of the path
    std::vector<bool> wanted;  ///< by target: it is to be hit, and is not yet
    std::vector<double> last_s;  ///< by target: the last firing time inside its region
    std::vector<PassingHit> chosen;
  };

  [[nodiscard]] Leg look_along(const Straight& straight) const;
  Leg& leg_along(const Straight& straight, bool last);
  void fire(Salvo& salvo, Leg& leg, std::size_t moment, const Straight& straight, bool last);
  const LegShot* shot_of(Leg& leg, Chance& chance, const Straight& straight, bool last, double after_s) const;

  const GuardProblem& problem_;
  const FiringMap& firing_map_;
  std::map<std::tuple<double, double, double, double, bool>, Leg>
      legs_;  // by ends, and whether it is the last
};

}  // namespace outrider
