// SimulatedGun: a water gun whose joints turn at their rates, and whose balls leave with its errors and fly
// exactly until their first contact.
#pragma once

#include <cstddef>
#include <vector>

#include "outrider/ballistics/moving_target.hpp"
#include "outrider/robot/observation.hpp"
#include "outrider/sim/execution_errors.hpp"
#include "outrider/sim/record.hpp"

namespace outrider {

/// What balls fly among, and at.
struct GunScene {
  const ShotRules& rules;
  const std::vector<FlightSpace>& spaces;  ///< one for all targets, or one for each
  const std::vector<Target>& targets;

  [[nodiscard]] const FlightSpace& space(std::size_t target) const {
    return spaces.size() == 1 ? spaces.front() : spaces[target];
  }
};

/// The record of a shot, but for its target, attempt and time. `contact` is what it touched first.
ReportShot shot_record(const Flight& flight, const Impact& impact, const FlightSpace& space,
                       const Target& target, double ball_radius_m, std::string contact);

class SimulatedGun {
 public:
  /// The scene must outlive the gun. The errors of shots and of moments are drawn from the two streams.
  SimulatedGun(const GunScene& scene, const ExecutionErrors& errors, const Rng& gun, const Rng& timing);

  /// A turn of both joints to angles relative to the body, each at its own rate.
  struct Turn {
    GunState from;
    double yaw_rad = 0.0;    ///< to turn by
    double pitch_rad = 0.0;  ///< to turn by
    double yaw_s = 0.0;
    double pitch_s = 0.0;
    double total_s = 0.0;
  };
  /// Towards a yaw in the world and a pitch, for a body with that heading.
  [[nodiscard]] Turn turn_towards(double yaw_rad, double pitch_rad, const Stance& stance,
                                  double heading_rad) const;
  void be_on(const Turn& turn, double after_s);
  /// From a state towards another, that long after both joints began.
  void be_between(GunState from, GunState to, double after_s);
  /// The barrel as it points in the world.
  [[nodiscard]] Shot barrel(const Stance& stance, double heading_rad) const;

  /// How much later than told the next shot from a robot that drives leaves.
  double draw_delay_s();
  /// Where a shot went.
  struct Thrown {
    Flight flight;
    Impact impact;
    double speed_mps = 0.0;  ///< of the muzzle
    Target target;           ///< where it was when the ball touched
  };
  /// A shot at `target`, for which `stand_in` of the scene stands, by a robot at a place with a velocity over
  /// the ground; at one that walks, the ball leaves at `fired_s`.
  Thrown throw_ball(const Shot& shot, std::size_t target, std::size_t stand_in, Vec2 position,
                    Vec2 velocity_mps, const Walk* walk, double fired_s);
  /// Counts the attempts at a target.
  int next_attempt(std::size_t target) { return ++attempts_[target]; }

  [[nodiscard]] const GunState& state() const { return state_; }
  [[nodiscard]] const GunScene& scene() const { return scene_; }

 private:
  GunScene scene_;
  ExecutionErrors errors_;
  Rng gun_rng_;
  Rng timing_rng_;
  GunState state_;
  std::vector<int> attempts_;  // by target
};

}  // namespace outrider
