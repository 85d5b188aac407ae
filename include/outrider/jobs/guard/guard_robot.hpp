// A simulated robot with a water gun: kinematic, deterministic, on a virtual clock.
//
// Drives and turns follow trapezoidal profiles exactly, then end a little off: the errors of the
// problem, drawn from named streams of the seed. A shot leaves with the errors of the gun and flies
// exactly until its first contact. Everything that happens goes into a record.
#pragma once

#include <span>

#include "outrider/ballistics/moving_target.hpp"
#include "outrider/ballistics/stance.hpp"
#include "outrider/core/rng.hpp"
#include "outrider/jobs/guard/arrivals.hpp"
#include "outrider/jobs/guard/site.hpp"
#include "outrider/jobs/guard/supply_gauge.hpp"
#include "outrider/robot/mission.hpp"
#include "outrider/sim/record.hpp"

namespace outrider {

/// What becomes of those who are hit.
struct Survival {
  double leave = 1.0;     ///< probability; who does not leave walks to another place
  double walk_mps = 1.0;  ///< 0: it is there at once
};

/// What the simulation is told of the intruders and the stores.
struct GuardSimParams {
  /// Where intruders come, they are the targets, in the order of entering, and the places where survivors go
  /// follow them.
  std::vector<Intruder> intruders = {};
  bool foreseen = false;  ///< all are seen at the start
  Survival survival = {};
  std::vector<Walk> walks = {};  ///< of targets that walk; each is seen until it is hit
  double look_s = 0.5;           ///< between two looks
  double sight_m = 0.0;          ///< largest error of a position seen
  StoreLevels levels = {};       ///< at the start; a store that holds less is full
};

class SimulatedGuard final : public Robot {
 public:
  /// The references must outlive the robot.
  SimulatedGuard(const GuardProblem& problem, const Site& site, std::uint64_t seed,
                 GuardSimParams params = {});

  Observation sense() override;
  void act(const Command& command) override;

  SimRecord record;  ///< so far

 private:
  void follow(const FollowWaypoints& command);
  void aim(const AimGun& command);
  void fire(const Fire& command);
  void fire_in_passing(const FireInPassing& command, Vec2 velocity_mps);
  void await_balls();
  Impact shoot(const Fire& command, Vec2 velocity_mps);
  void wait(const Wait& command);
  void fill(const Fill& command);
  void gauge();
  void turn_to(double heading_rad);
  void drive_to(Vec2 goal, std::span<const FireInPassing> shots);
  void sample();
  [[nodiscard]] Stance stance() const;
  void leave_or_go_on(std::size_t who);
  void look(TargetReport& told);
  [[nodiscard]] bool news() const;
  void log(std::string kind, std::string text);

  const GuardProblem& problem_;
  const Site& site_;
  Rng arrival_rng_;
  Rng gun_rng_;
  double time_s_ = 0.0;
  Pose2 pose_;
  double gun_yaw_rad_ = 0.0;  // relative to the body
  double gun_pitch_rad_ = 0.0;
  std::vector<ShotResult> landed_;  // not yet told of
  Rng timing_rng_;
  SupplyGauge gauge_;
  std::vector<int> attempts_;  // by target
  GuardSimParams params_;
  std::size_t seen_ = 0;  // intruders that have been told of
  Rng survival_rng_;
  std::vector<std::size_t> at_;          // by intruder: the target that stands for it now
  std::vector<TargetArrival> survived_;  // not yet told of
  std::vector<char> gone_;               // by target, of those who walk
  std::uint64_t looks_ = 0;              // so far
  Rng sight_rng_;
};

}  // namespace outrider
